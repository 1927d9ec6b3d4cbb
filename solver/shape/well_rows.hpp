// The constraints of a sheet whose total energy has a well at its shape, springs of one rate on all
// diagonals: the springs' length off their rest, s = |L - L_rest|, has 2 E = k s^2.
#pragma once

#include "solver/optimise/path_gradients.hpp"
#include "solver/shape/shape_options.hpp"
#include "solver/shape/shape_row.hpp"

namespace misalign::solver {

/// Springs relaxed at the shape: s falls from the stowed angle, and from flat, to the shape between
/// all neighbours of these angles. Returns false where a gradient is not found.
bool add_energy_rows(const Sheet& sheet, const ShapeOptions& options,
                     const std::vector<double>& angles_deg, PathGradients* gradients,
                     std::vector<ShapeRow>& rows);

/// Angles between flat and `to_deg`, in steps of one degree, across which s does not fall towards
/// the shape.
std::vector<double> energy_turns_deg(const Sheet& sheet, double at_deg, double to_deg);

/// Springs relaxed flat and at the shape: every diagonal has the same length in both, and s reaches
/// the barrier between them and at the stowed angle. Returns false where a gradient is not found.
bool add_bistable_rows(const Sheet& sheet, const ShapeOptions& options, PathGradients* gradients,
                       std::vector<ShapeRow>& rows);

}  // namespace misalign::solver
