// Draws a sheet for printed pages: exploded, assembled and folded.
#pragma once

#include <string>

#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// All panels with their numbers, their distances from the middle enlarged by a quarter.
std::string exploded_picture(const solver::Sheet& sheet);
/// The flat sheet with mountains and valleys, ball joints and diagonals, which the caption calls
/// `diagonals`.
std::string assembled_picture(const solver::Sheet& sheet, const std::string& diagonals);
/// The sheet in a folded shape, captioned with its pilot angle.
std::string folded_picture(const solver::Sheet& sheet, const Eigen::Matrix3Xd& shape_mm,
                           double pilot_deg);

}  // namespace misalign::schema
