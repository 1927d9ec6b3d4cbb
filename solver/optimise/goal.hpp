// What an optimisation makes as large as can be, or keeps from being small.
#pragma once

#include <limits>

namespace misalign::solver {

enum class OptimiseGoal {
  critical_friction,       ///< of rigid panels, as `deploy` has it
  bent_critical_friction,  ///< of panels that bend
  static_friction,         ///< of panels that bend, moving slowly: at every angle
  miscut_margin,           ///< of models with a threshold (solver/model/miscut_margin.hpp), mm
  energy,                  ///< of the springs where it is let go, panels rigid: N mm
  deploys_from,            ///< up to where diagonals go one way and it goes on folding, deg
  rest_stiffness,          ///< where its springs rest (rest_stiffness.hpp), N mm per rad
  thickness,               ///< of plates, from flat to the angle of use, as `contact` has it: mm
  yield,                   ///< share of miscut copies that deploy, as `tolerance` counts them
  spare_diagonals          ///< that need no spring, as `actuators` has it (spare_diagonals.hpp)
};

/// Whether what is foreseen next to a sheet is the goal, to first order. Of the others it says only
/// which way to go.
constexpr bool is_foreseen(OptimiseGoal goal) {
  return goal != OptimiseGoal::deploys_from && goal != OptimiseGoal::yield &&
         goal != OptimiseGoal::spare_diagonals;
}

/// More of it there cannot be.
constexpr double most_of(OptimiseGoal goal) {
  if (goal == OptimiseGoal::deploys_from) return 180;
  return goal == OptimiseGoal::yield ? 1 : std::numeric_limits<double>::infinity();
}

/// What another goal is to be at least.
struct OptimiseFloor {
  OptimiseGoal of;
  double least;  ///< as the goal

  bool operator==(const OptimiseFloor&) const = default;
};

}  // namespace misalign::solver
