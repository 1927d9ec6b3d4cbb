// What the goals of an optimisation become next to one sheet, to first order.
#pragma once

#include <vector>

#include "solver/optimise/sheet_changes.hpp"

namespace misalign::solver {

/// The goal is the least of all, in its unit: energy between two angles over what the creases turn
/// between them, N mm and mm; how far a diagonal goes on over how fast that changes, mm and mm per
/// mm; a thickness, an energy or a stiffness over 1. Of those that are not foreseen
/// (optimise_goal.hpp) what leads to more of it.
struct LocalGoal {
  double amount, over;
  Eigen::VectorXd row;  ///< of the amount, per mm of the coordinates
};

/// By the sheet's springs, as the options have them. Empty where they are not known.
std::vector<LocalGoal> local_goals(OptimiseGoal goal, SheetChanges& around);

}  // namespace misalign::solver
