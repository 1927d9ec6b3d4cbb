// The study of shapes: flat vertices with which a folded sheet lies on a target surface, while its
// diagonals are monotone from flat to the stowed angle.
//
// Holes leave one degree of freedom by their count, so no condition of compatibility binds the flat
// vertices. A step is a quadratic program: least squares of the vertices' distances, linearised
// (PathGradients), with rows for what must stay, within a box that shrinks where these were wrong.
// The target's curvature grows from a plane in steps.
#pragma once

#include "solver/shape/shape_descent.hpp"
#include "solver/sheet/sheet.hpp"
#include "solver/studies/study_result.hpp"

namespace misalign::solver {

struct ShapeStudy {
  Eigen::Matrix2Xd shifts_mm;
  ShapePose pose;
  Eigen::VectorXd sides;  ///< those of the target's rows (ShapeTarget)
  double rms_mm, max_mm;
  int steps = 0, evaluations = 0;
  double deploys_from_deg = 0;
  /// Angle from which springs that are relaxed at the shape drive it there; 0: none do. Bistable
  /// sheets: the end of the path, or the stowed angle.
  double driven_from_deg = 0;
  std::vector<ShapeLimit> limits;
  /// True if the misfit is below a thousandth of a panel's width, and no limit is violated.
  bool is_reached = false;
};

/// Shapes a sheet of this solver's model, whose base must fold to the stowed angle. Reasons:
/// overconstrained, path_lost.
StudyResult<ShapeStudy> shape(SheetSolver& solver, const ShapeOptions& options);

}  // namespace misalign::solver
