// What an optimisation makes as large as can be, or keeps from being small.
#pragma once

namespace misalign::solver {

enum class OptimiseGoal {
  critical_friction,       ///< of rigid panels, as `deploy` has it
  bent_critical_friction,  ///< of panels that bend
  static_friction,         ///< of panels that bend, moving slowly: at every angle
  miscut_margin            ///< of models with a threshold (solver/model/miscut_margin.hpp), mm
};

/// What another goal is to be at least.
struct OptimiseFloor {
  OptimiseGoal of;
  double least;  ///< as the goal: N mm per mm, or mm

  bool operator==(const OptimiseFloor&) const = default;
};

}  // namespace misalign::solver
