// The constraints of a sheet while it is shaped: inequalities with their gradients by the flat
// vertices.
#pragma once

#include <vector>

#include "solver/optimise/path_gradients.hpp"
#include "solver/shape/shape_options.hpp"
#include "solver/shape/shape_row.hpp"

namespace misalign::solver {

/// Rows of a sheet, whose way reaches the shape's angle, with gradients where these are given. None
/// where a gradient is not found.
std::optional<std::vector<ShapeRow>> shape_rows(const Sheet& sheet, const ShapeOptions& options,
                                                const WantedRows& wanted, PathGradients* gradients);

/// Levels of all floors next to a sheet, each at most `raise` times what it has. None where a goal
/// has no value or gradient.
std::optional<std::vector<WantedRows::Level>> floor_levels(const Sheet& sheet,
                                                           const ShapeOptions& options,
                                                           double raise);

}  // namespace misalign::solver
