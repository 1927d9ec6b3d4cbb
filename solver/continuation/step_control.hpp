// Step control of a path: what it does next, decided from a few numbers after each Newton
// iteration. It reaches the next station with the pilot held, or goes along the arc until the pilot
// comes to it or reaches a limit point. No mechanism, no vector: the same decisions for a single
// path, for a lane among others and for a homotopy, whatever solves the equations.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/linear/newton.hpp"

namespace misalign::solver {

/// Of the way along the arc (pseudo-arclength continuation: Keller; Allgower & Georg, Introduction
/// to Numerical Continuation Methods, ch. 6). Lengths are Euclidean, over all unknowns.
struct ArcOptions {
  double longest_step_rad = 0.1;
  double shortest_step_rad = 1e-9;  ///< below it the path has stalled
  /// Where the pilot's rate falls, steps get no shorter than this before a limit point was seen.
  double least_step_by_fall_rad = 0.005;
  double least_tangent_cosine = 0.966;  ///< 15 degrees between the tangents of neighbouring points
  int most_steps = 5000;                ///< from one station to the next
  /// How well the pilot's largest value is known: 6e-8 degrees; 0.001 is asked for.
  double limit_tolerance_rad = 1e-9;
  /// Where a path stalls or finds a limit point this close below a station, the station may be
  /// singular, as 180 degrees where another branch crosses: it is tried once with the pilot held.
  /// 0: never.
  double singular_gap_rad = 0;
  /// Of a crease in that try, sin(half of its turn). The curve's own solution is at a distance like
  /// the root of the gap: 4e-4 rad from 1e-5 degrees.
  double longest_try_half_sine = 5e-3;
};

struct StepControlOptions {
  double closure_tolerance = NewtonOptions{}.closure_tolerance;
  /// The same of the points between stations, on the arc.
  double arc_closure_tolerance = NewtonOptions{}.closure_tolerance;
  /// Extrapolated stations converge in one or two corrections; more have lost the branch.
  int max_corrections = 10;
  /// Of a crease from one station to the next, sin(half of it), and of all its corrections together
  /// (rad): what has gone farther is looked for along the arc. Steps of 1 degree move a crease by 1
  /// to 3 degrees, more only within 0.1 of a fold limit; 20 degrees is a jump to another branch.
  double longest_half_sine = 0.17364817766693033;
  double longest_correction_rad = 2 * kPi;
  /// Of a path's first station, unless that is flat: all corrections together, as a share of the
  /// pilot's angle there. What is farther from the base folding may belong to another branch: of
  /// 2,400 sheets with sector angles of 20 to 89.5 degrees the nearest such start was 0.73 off.
  double longest_start_share = 0.5;
  /// Between the tangents of neighbouring stations: where they differ more, a limit point may lie
  /// between them. As on the arc, 15 degrees.
  double least_tangent_cosine = ArcOptions{}.least_tangent_cosine;
  /// A limit point that leaves at least this share of the way to the plan's end is not located any
  /// better.
  double limit_certain_share = 1;
  ArcOptions arc;
};

/// What is known after an iteration; `state` is the corrected one, `last` the last one believed.
struct NewtonReport {
  double open_by;            ///< before the correction
  double correction_rad;     ///< its largest entry
  int determinant_sign;      ///< of the Jacobian without the pilot's column
  int orientation;           ///< sign of det [J; t] for the unit tangent as it was computed
  double tangent_pilot;      ///< that tangent's pilot entry
  double tangent_cosine;     ///< with the tangent at `last`, as it was oriented
  double largest_half_sine;  ///< of a crease's turn from `last` to `state`
  HalfAngle<double> last_pilot, pilot;
};

/// What to do with the lane now.
struct PathStep {
  bool believe = false;     ///< `state` becomes `last`, its tangent the newest
  double tangent_sign = 1;  ///< with which the tangent is kept
  bool arrived = false;     ///< at the station: to be seen before `proceed`
  bool ended = false;       ///< result() says how
  bool depart = false;      ///< from `last` by along[k] times the k-th newest tangent (rad)
  double along[3] = {0, 0, 0};
  bool hold = false;  ///< put the pilot at `pilot` after departing
  HalfAngle<double> pilot{1, 0};
};

class StepControl {
 public:
  explicit StepControl(const StepControlOptions& options = {}) : options_(options) {}

  /// A path whose start lies near the plan's station number `first_station`. Stations ascend, or
  /// descend where the arc is not needed. `forward_sign` is the determinant's on this half of the
  /// curve, 0 if it is not known yet.
  void begin(const PathPlan& plan, std::size_t first_station, int forward_sign);
  PathStep after(const NewtonReport& report);
  /// From the station where it arrived to the next one.
  PathStep proceed();
  /// The visitor has seen enough.
  PathStep stop() { return end(PathEnd::stopped); }

  bool under_way() const { return phase_ != Phase::idle; }
  /// Whether the corrector is free to move the pilot.
  bool on_arc() const { return phase_ == Phase::arc; }
  const Station& target() const { return plan_->stations[station_]; }
  int forward_sign() const { return forward_sign_; }
  const PathResult& result() const { return result_; }

 private:
  enum class Phase { idle, stepping, arc, landing, last_try };

  PathStep converged(const NewtonReport& report);
  PathStep found_on_arc(const NewtonReport& report);
  PathStep arrive(const NewtonReport& report, double tangent_sign);
  PathStep not_there(const NewtonReport& report);
  PathStep begin_arc(const NewtonReport& report);
  PathStep go_along(const HalfAngle<double>& last_pilot);
  double next_along_arc(double tangent_pilot) const;
  PathStep at_limit_point(double rise_rad, const HalfAngle<double>& last_pilot);
  PathStep no_way_on(PathEnd why, const HalfAngle<double>& last_pilot);
  PathStep end(PathEnd end);

  StepControlOptions options_;
  const PathPlan* plan_ = nullptr;
  std::size_t station_ = 0;
  Phase phase_ = Phase::idle;
  int forward_sign_ = 0;
  int corrections_ = 0;
  double last_open_ = 0;
  double corrected_rad_ = 0;             // since departing
  int tangents_ = 0;                     // known at the stations before, newest first
  double tangent_pilot_[3] = {1, 1, 1};  // their pilot entries
  double step_rad_[2] = {0, 0};          // pilot steps between those stations
  double ds_ = 0;                        // on the arc: the next step
  double bend_ = 0;    // fall of the tangent's pilot entry per unit of length, past a limit point
  int arc_steps_ = 0;  // since the last station
  PathResult result_{};
};

}  // namespace misalign::solver
