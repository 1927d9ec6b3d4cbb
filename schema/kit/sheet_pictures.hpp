// Draws a sheet for printed pages: assembled, row by row, on its sheets of material, and folded.
#pragma once

#include <string>

#include "schema/kit/kit_drawing.hpp"

namespace misalign::schema {

/// The flat sheet with a row of panels in colour, numbered, and the rows before it in grey.
std::string row_picture(const solver::Sheet& sheet, int row, const std::string& caption);
/// The panels of a kit on a sheet of material, each row of the sheet in a colour of its own, with
/// the registration marks.
std::string bed_picture(const solver::Sheet& sheet, const Kit& kit, std::size_t bed);
/// The flat sheet with mountains and valleys, ball joints and diagonals, which the caption calls
/// `diagonals`.
std::string assembled_picture(const solver::Sheet& sheet, const std::string& diagonals);
/// The sheet in a folded shape, captioned with its pilot angle.
std::string folded_picture(const solver::Sheet& sheet, const Eigen::Matrix3Xd& shape_mm,
                           double pilot_deg);

}  // namespace misalign::schema
