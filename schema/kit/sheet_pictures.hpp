// Pictures of a sheet for pages that are printed: taken apart, put together, folded.
#pragma once

#include <string>

#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// All panels, each as far from the middle as a quarter more than it lies, with their numbers.
std::string exploded_picture(const solver::Sheet& sheet);
/// Flat, with mountains and valleys, springs and ball joints.
std::string assembled_picture(const solver::Sheet& sheet);
/// In this shape, where the pilot is at that angle.
std::string folded_picture(const solver::Sheet& sheet, const Eigen::Matrix3Xd& shape_mm,
                           double pilot_deg);

}  // namespace misalign::schema
