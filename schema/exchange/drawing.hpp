// Draws a pattern: the crease pattern for a cutter, and folded sheets as OBJ for a modeller.
#pragma once

#include <string>

#include "schema/exchange/line_drawing.hpp"
#include "schema/pattern/pattern_file.hpp"
#include "solver/kinematics/mechanism.hpp"

namespace misalign::schema {

/// The crease pattern with a margin: layers `cut` (black: perimeter and holes, closed outlines),
/// `mountain` (red) and `valley` (blue); and, hidden so that no cutter follows them, one named
/// `diagonals` (green) and `labels` (of the vertices, and the diagonals' numbers from 0).
LineDrawing crease_pattern_drawing(const Pattern& base, const Eigen::Matrix2Xd& vertices_mm,
                                   const solver::Mechanism& mechanism, const std::string& title,
                                   const std::string& diagonals);

/// A folded sheet as Wavefront OBJ, 3 x N coordinates in mm, a quadrilateral for each kept facet.
std::string folded_obj(const Pattern& base, const Eigen::Matrix3Xd& shape_mm,
                       const std::string& title);

}  // namespace misalign::schema
