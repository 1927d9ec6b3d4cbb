// Linearises the goals of an optimisation around one sheet.
#pragma once

#include <vector>

#include "solver/optimise/sheet_changes.hpp"

namespace misalign::solver {

/// A term of a goal: numerator / divisor, in the goal's unit, linearised at this sheet. A goal is
/// the least of its terms; terms of goals that are not exact (goal.hpp) only lead to larger values.
struct GoalTerm {
  double numerator, divisor;
  /// Gradient of the numerator, per mm of the variables; where the divisor varies, less the term's
  /// value times the divisor's gradient.
  Eigen::VectorXd row;
};

// Each function returns the terms of its goal, with the springs of the options. Where a gradient is
// not known there are none, or `changes.is_known` is false.

// Frictions: energy between two angles, N mm, over the creases' turning between them, mm.
std::vector<GoalTerm> local_critical_friction(SheetChanges& changes);
std::vector<GoalTerm> local_bent_critical_friction(SheetChanges& changes);
std::vector<GoalTerm> local_static_friction(SheetChanges& changes);
// One term, over 1.
std::vector<GoalTerm> local_energy(SheetChanges& changes);
std::vector<GoalTerm> local_rest_stiffness(SheetChanges& changes);
/// Largest thickness before contact, mm, of each pair of panels that limits it.
std::vector<GoalTerm> local_thickness(SheetChanges& changes);
/// The margin against miscuts (solver/model/miscut_margin.hpp): change of a diagonal in a section,
/// mm, over the norm of its gradient.
std::vector<GoalTerm> local_margin(SheetChanges& changes);
/// The change of every diagonal in each degree from the required angle to beyond the first
/// reversal, and the distance of the fold limit, scaled to mm.
std::vector<GoalTerm> local_deployed_angle(SheetChanges& changes);
/// Moment of the best set with one spring fewer, at each angle, over the least moment of all
/// springs.
std::vector<GoalTerm> local_spare_diagonals(SheetChanges& changes);

}  // namespace misalign::solver
