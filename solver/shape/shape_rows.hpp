// The constraints of a sheet while it is shaped: inequalities with their gradients by the flat
// vertices.
#pragma once

#include <vector>

#include "solver/optimise/path_gradients.hpp"
#include "solver/shape/shape_options.hpp"

namespace misalign::solver {

/// The pilot angles between which diagonals keep their directions, and these.
struct WantedDirections {
  std::vector<double> angles_deg;  ///< ascending, without flat
  Eigen::VectorXd sides;           ///< 1 longer, -1 shorter: per diagonal; empty: none is asked for
};

/// slack + by_mm . (change of the flat vertices) >= 0; mm, or panel widths times rad.
struct ShapeRow {
  enum class Kind { corner, edge, fold, limit, direction } kind;
  int where;
  double pilot_deg;
  double slack;
  Eigen::RowVectorXd by_mm;  ///< x and y of each vertex in turn; empty if it was not asked for
};

/// Rows of a sheet, whose way reaches the shape's angle, with gradients where these are given. None
/// where a gradient is not found.
std::optional<std::vector<ShapeRow>> shape_rows(const Sheet& sheet, const ShapeOptions& options,
                                                const WantedDirections& wanted,
                                                PathGradients* gradients);

}  // namespace misalign::solver
