// The objective and the constraints of an optimisation.
#pragma once

#include <optional>

#include "solver/optimise/optimise_options.hpp"

namespace misalign::solver {

/// Returns whether spring forces at the angle of use, in `options.deploying`, keep their limit.
bool is_strong_enough(const Sheet& sheet, const OptimiseOptions& options);
/// Returns whether it deploys from the required angle, its way reaches the angle of use, and it
/// keeps the limits of stroke and force.
bool fits(const Sheet& sheet, const OptimiseOptions& options);
/// Returns whether, up to the required angle, no diagonal turns back between samples and no crease
/// is almost folded flat. A certificate needs this, a draw does not.
bool goes_all_the_way(const Sheet& sheet, const OptimiseOptions& options);
/// Returns whether, with free shifts, every diagonal keeps its least slope at every angle, where
/// required, or at least that of the sheet before.
bool keeps_slope(const Sheet& sheet, const Sheet& before, const OptimiseOptions& options);
/// The value of the goal of a feasible sheet; none where it violates a constraint or a floor, does
/// not go all the way, or has no value.
std::optional<double> objective(const Sheet& sheet, const OptimiseOptions& options);

}  // namespace misalign::solver
