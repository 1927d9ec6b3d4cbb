// The functions of each goal of an optimisation. To add a goal: its row in studies/goal.cpp, its
// value and its row here, its linearisation in local_goals.
#pragma once

#include <optional>
#include <vector>

#include "solver/studies/goal.hpp"

namespace misalign::solver {

class Sheet;
struct GoalTerm;
struct OptimiseOptions;
struct SheetChanges;

/// The value for a sheet that can be released, with the sign of Goal::in_unit; none where its study
/// has no value.
std::optional<double> value_of(const Goal& goal, const Sheet& sheet,
                               const OptimiseOptions& options);
/// The terms next to a sheet, to first order in its shifts and springs.
std::vector<GoalTerm> linearization_of(const Goal& goal, SheetChanges& changes);

}  // namespace misalign::solver
