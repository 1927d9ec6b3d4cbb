// The options and the result of an optimisation.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/bending/bent_panels.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::solver {

/// One sheet with its springs.
struct DesignPoint {
  Eigen::Matrix2Xd shifts_mm;
  double stiffness_n_per_mm, preload_n;
};

struct OptimiseOptions {
  const Goal* goal = &goal_table().front();
  ReleaseOptions deploying;   ///< springs, hinges, panels, and from where it is let go
  BentPanelsOptions bending;  ///< where the goal is of panels that bend
  std::vector<int> shifted;   ///< the vertices that may be shifted
  /// In columns, what moves together: x and y of each of these in turn. Empty: each by itself.
  Eigen::MatrixXd moves;
  double amplitude_mm = 0.4;  ///< no farther in x, nor in y
  bool ternary = false;       ///< only by nothing or that much
  double grid_mm = 0;         ///< only by whole multiples of it; 0: by any
  /// Within which the springs' rate and what all are left with at flat may be chosen as well; none:
  /// as they are.
  struct Range {
    double least, most;
  };
  std::optional<Range> stiffness_n_per_mm, preload_n;
  /// Up to where plates are to fold, as `contact` asks; none: D.
  std::optional<double> used_from_deg;
  /// The share of a sheet's miscut copies that deploy, where that is asked.
  std::function<std::optional<double>(const Sheet&)> yield;
  int deploys_from_sample = 1;            ///< D at least
  std::optional<double> stroke_limit;     ///< |L - L0| / L0 of every diagonal, up to D
  std::optional<double> largest_force_n;  ///< of every spring where it is let go, panels rigid
  std::vector<OptimiseFloor> floors;
  /// What free shifts leave every diagonal: so much times the sine of the pilot's angle, mm per
  /// degree. A diagonal that hardly goes on cannot be built, nor certified. At every angle, or, as
  /// campaigns have it, in the mean between angles some degrees apart.
  double least_slope_mm_per_deg = 1e-3;
  bool slope_at_every_angle = false;
  /// Called in between, some times a second: what it throws ends the search.
  std::function<void()> watch = [] {};
  int most_steps = 200;
  int most_evaluations = 400;  ///< sheets that are folded for one step of ternary shifts
};

struct Optimised {
  enum class StopReason { no_step_is_better, most_steps };

  /// The limits that keep the end from being better: by how much the goal would grow with a little
  /// more room (to first order; 0: it does not limit).
  struct Limits {
    double per_share_of_stroke = 0;  ///< for each 1 of the stroke limit
    double per_n_of_force = 0;       ///< for each N of the largest force
    double per_mm_of_amplitude = 0;  ///< for each mm of amplitude
    /// The gain for each N/mm, and N, by which the range in which it is chosen is wider, at either
    /// end.
    double per_n_per_mm_of_stiffness = 0, per_n_of_preload = 0;
    std::vector<double> per_floor;  ///< for each 1 that the floor is lower
    /// Diagonals that would turn back, where: the one with the largest price first.
    struct Turning {
      int diagonal;
      double pilot_deg, per_mm;
    };
    std::vector<Turning> turning;
    bool by_fold_limit = false;
  };

  OptimiseOptions options;
  double from_deg;
  /// The start, then the sheet after each step; the value of the goal for each.
  struct Taken : DesignPoint {
    double value;
  };
  std::vector<Taken> taken;
  StopReason stop_reason;
  int evaluations = 0;           ///< sheets that were folded
  std::optional<Limits> limits;  ///< of free shifts, at the last sheet, of what is foreseen

  const Taken& start() const { return taken.front(); }
  const Taken& best() const { return taken.back(); }
  int steps() const { return static_cast<int>(taken.size()) - 1; }
};

}  // namespace misalign::solver
