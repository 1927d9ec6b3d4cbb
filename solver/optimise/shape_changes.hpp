// Linearises the distances of a sheet from its target.
#pragma once

#include <vector>

#include "solver/optimise/local_goals.hpp"

namespace misalign::solver {

// Terms of the negative distances, mm, over 1, with the target of the options. The pose is fitted
// anew, to first order in the distances (Gauss and Newton).
/// The mean's gradient; the other terms are scaled distances, which are less.
std::vector<GoalTerm> local_shape_rms(SheetChanges& changes);
/// Both signs of each distance from a surface, or the distance from each place.
std::vector<GoalTerm> local_shape_max(SheetChanges& changes);

}  // namespace misalign::solver
