// The goals of an optimisation next to one sheet, to first order.
#pragma once

#include <vector>

#include "solver/optimise/sheet_changes.hpp"

namespace misalign::solver {

/// A piece of a goal, which is the least of all pieces, in its unit: energy between two angles over
/// what the creases turn between them, N mm and mm; how far a diagonal goes on over how fast that
/// changes, mm and mm per mm; a thickness, an energy or a stiffness over 1. Goals that are not
/// exact (goal.hpp) have pieces that lead to more of them.
struct LocalGoal {
  double amount, over;
  Eigen::VectorXd row;  ///< of the amount, per mm of the variables
};

// Each gives its pieces by the sheet's springs, as the options have them: none where the changes
// are not known.

std::vector<LocalGoal> local_critical_friction(SheetChanges& changes);
std::vector<LocalGoal> local_bent_critical_friction(SheetChanges& changes);
std::vector<LocalGoal> local_static_friction(SheetChanges& changes);
std::vector<LocalGoal> local_energy(SheetChanges& changes);
std::vector<LocalGoal> local_rest_stiffness(SheetChanges& changes);
std::vector<LocalGoal> local_thickness(SheetChanges& changes);
/// The margin against miscuts, as solver/model/miscut_margin.hpp has it: a piece for each section.
std::vector<LocalGoal> local_margin(SheetChanges& changes);
/// What every diagonal goes on, for each degree, behind where the first of them turns back, and the
/// room before the fold limit by as much.
std::vector<LocalGoal> local_deployed_angle(SheetChanges& changes);
/// The moments of the best set of one spring fewer over the least of all.
std::vector<LocalGoal> local_spare_diagonals(SheetChanges& changes);

}  // namespace misalign::solver
