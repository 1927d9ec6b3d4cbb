// The lengths of a sheet's diagonals at one pilot angle, with their gradients where these are
// given.
#pragma once

#include <optional>

#include "solver/optimise/path_gradients.hpp"

namespace misalign::solver {

struct DiagonalLengths {
  Eigen::VectorXd mm;
  Eigen::MatrixXd by_mm;  ///< diagonals x (2 vertices): mm per mm; empty if it was not asked for
};

/// None where a gradient is not found. The sheet's way must reach the angle.
std::optional<DiagonalLengths> diagonal_lengths(const Sheet& sheet, double pilot_deg,
                                                PathGradients* gradients);

/// The change of a length between two pilot angles whose slope is `slope_mm_per_deg` at 90 degrees,
/// times the sine elsewhere.
double change_by_slope_mm(double slope_mm_per_deg, double from_deg, double to_deg);

}  // namespace misalign::solver
