// The options and the result of an optimisation.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/bending/bent_panels.hpp"
#include "solver/contact/spring_clearance.hpp"
#include "solver/studies/goal.hpp"

namespace misalign::solver {

class ShapeMeasure;

/// One sheet with its springs.
struct DesignPoint {
  Eigen::Matrix2Xd shifts_mm;
  double stiffness_n_per_mm, preload_n;
};

struct OptimiseOptions {
  const Goal* goal = &goal_table().front();
  ReleaseOptions deploying;   ///< springs, hinges, panels, and angle of use
  BentPanelsOptions bending;  ///< options of goals with bending panels
  std::vector<int> shifted;   ///< vertices that may be shifted
  /// Joint moves, in columns: x and y of each of these vertices in turn. Empty: each moves by
  /// itself.
  Eigen::MatrixXd moves;
  double amplitude_mm = 0.4;  ///< largest shift in x and in y
  bool ternary = false;       ///< true: shifts are 0 or plus or minus the amplitude
  double grid_mm = 0;         ///< shifts are multiples of it; 0: any
  /// Ranges in which the springs' stiffness and their common preload are variable; none: fixed.
  struct Range {
    double least, most;
  };
  std::optional<Range> stiffness_n_per_mm, preload_n;
  /// Angle of use of plates and strokes, as in `contact`; none: D.
  std::optional<double> used_from_deg;
  std::optional<SpringBodies> bodies;  ///< springs as bodies, for their clearance
  /// Share of a sheet's miscut copies that deploy, for its goal.
  std::function<std::optional<double>(const Sheet&)> yield;
  std::shared_ptr<const ShapeMeasure> shape;  ///< target of goals of shapes; null: none
  int deploys_from_sample = 1;                ///< least D
  std::optional<double> stroke_limit;         ///< |L - L0| / L0, up to the angle of use
  std::optional<double> largest_force_n;      ///< spring force at the angle of use, panels rigid
  std::vector<OptimiseFloor> floors;
  /// Least slope of every diagonal with free shifts, over the sine of the pilot's angle, mm per
  /// degree: a diagonal that hardly changes can be neither built nor certified. It holds at every
  /// angle, or, as in campaigns, in the mean between angles some degrees apart.
  double least_slope_mm_per_deg = 1e-3;
  bool slope_at_every_angle = false;
  /// Called a few times a second: an exception from it ends the search.
  std::function<void()> watch = [] {};
  std::function<void(int steps)> see_steps = [](int) {};  ///< called after each step
  int most_steps = 200;
  /// True if single free shifts are tried, too, where no other step is better.
  bool tries_flips = true;
  int most_evaluations = 400;  ///< sheets folded for one step of ternary shifts
};

struct Optimised {
  enum class StopReason { no_step_is_better, most_steps };

  /// Prices of the limits at the optimum: the goal's growth per unit of relaxation (to first order;
  /// 0: the limit is not active).
  struct Limits {
    double per_share_of_stroke = 0;  ///< per 1 of the stroke limit
    double per_n_of_force = 0;       ///< per N of the largest force
    double per_mm_of_amplitude = 0;  ///< per mm of amplitude
    /// Gain per N/mm, and per N, by which the range is wider at either end.
    double per_n_per_mm_of_stiffness = 0, per_n_of_preload = 0;
    std::vector<double> per_floor;  ///< per unit by which the floor is lower
    /// Diagonals that would turn back, and the angles; the largest price first.
    struct Turning {
      int diagonal;
      double pilot_deg, per_mm;
    };
    std::vector<Turning> turning;
    std::optional<double> energy_deg;  ///< angle where the filling's energy would rise
    bool by_fold_limit = false;
  };

  OptimiseOptions options;
  double from_deg;
  /// The start, then the sheet after each step, each with the value of the goal (Goal::in_unit).
  struct Taken : DesignPoint {
    double value;
  };
  std::vector<Taken> taken;
  StopReason stop_reason;
  int evaluations = 0;           ///< sheets that were folded
  std::optional<Limits> limits;  ///< linearised at the optimum; only of free shifts

  const Taken& start() const { return taken.front(); }
  const Taken& best() const { return taken.back(); }
  int steps() const { return static_cast<int>(taken.size()) - 1; }
};

}  // namespace misalign::solver
