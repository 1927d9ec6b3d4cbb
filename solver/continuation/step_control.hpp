// What a path does next, decided from a few numbers after each Newton iteration: reach the next
// stop with the pilot held, or walk along the curve until the pilot comes to it or turns. No
// mechanism, no vector: the same decisions for a single path and for a lane among others.
#pragma once

#include "solver/continuation/path.hpp"

namespace misalign::solver {

struct CourseOptions {
  double closure_tolerance = NewtonOptions{}.closure_tolerance;
  /// The same of the points between stops that a walk goes over.
  double walk_closure_tolerance = NewtonOptions{}.closure_tolerance;
  /// Extrapolated stops converge in one or two corrections; more have lost the branch.
  int max_corrections = 10;
  /// Of a crease from one stop to the next, sin(half of it), and of all its corrections together
  /// (rad): what has gone farther is not believed without a walk.
  double longest_half_sine = kJumpHalfSine;
  double longest_correction_rad = 2 * kPi;
  /// Of a path's first stop: all corrections together, as a share of the pilot's angle there. What
  /// is farther from the base folding may belong to another branch: of 2,400 sheets with sector
  /// angles of 20 to 89.5 degrees the nearest such start was 0.73 off.
  double longest_start_share = 0.5;
  /// Between the tangents of neighbouring stops: where they differ more, a turn may lie between
  /// them. As for the walk, 15 degrees.
  double least_tangent_cosine = ArcLengthOptions{}.least_tangent_cosine;
  /// A turn that leaves at least this share of the way to the plan's end is not located any better.
  double turn_certain_share = 1;
  /// Of the walk along the curve: the same as for the reference's.
  ArcLengthOptions walk;
};

/// What is known after an iteration; `state` is the corrected one, `last` the last one believed.
struct Reading {
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
struct Move {
  bool believe = false;     ///< `state` becomes `last`, its tangent the newest
  double tangent_sign = 1;  ///< with which the tangent is kept
  bool arrived = false;     ///< at the stop: to be seen before `proceed`
  bool ended = false;       ///< result() says how
  bool depart = false;      ///< from `last` by along[k] times the k-th newest tangent (rad)
  double along[3] = {0, 0, 0};
  bool hold = false;  ///< put the pilot at `pilot` after departing
  HalfAngle<double> pilot{1, 0};
};

class Course {
 public:
  explicit Course(const CourseOptions& options = {}) : options_(options) {}

  /// A path whose start lies near the plan's stop number `first_stop`. Stops ascend, or descend
  /// where no walk is needed. `forward_sign` is the determinant's on this half of the curve, 0 if
  /// it is not known yet.
  void begin(const PathPlan& plan, std::size_t first_stop, int forward_sign);
  Move after(const Reading& reading);
  /// From the stop where it arrived to the next one.
  Move proceed();
  /// The visitor has seen enough.
  Move stop() { return end(PathEnd::stopped); }

  bool under_way() const { return phase_ != Phase::idle; }
  /// Whether the corrector is free to move the pilot.
  bool walking() const { return phase_ == Phase::walking; }
  const Stop& target() const { return plan_->stops[stop_]; }
  int forward_sign() const { return forward_sign_; }
  const PathResult& result() const { return result_; }

 private:
  enum class Phase { idle, stepping, walking, landing };

  Move converged(const Reading& reading);
  Move walked(const Reading& reading);
  Move arrive(const Reading& reading, double tangent_sign);
  Move not_there(const Reading& reading);
  Move begin_walk(const Reading& reading);
  Move walk_on(const HalfAngle<double>& last_pilot);
  Move end(PathEnd end);

  CourseOptions options_;
  const PathPlan* plan_ = nullptr;
  std::size_t stop_ = 0;
  Phase phase_ = Phase::idle;
  int forward_sign_ = 0;
  int corrections_ = 0;
  double last_open_ = 0;
  double corrected_rad_ = 0;             // since departing
  int tangents_ = 0;                     // known at the stops before, newest first
  double tangent_pilot_[3] = {1, 1, 1};  // their pilot entries
  double step_rad_[2] = {0, 0};          // pilot steps between those stops
  double ds_ = 0, bend_ = 0;             // of the walk: see ArcLength
  int walk_steps_ = 0;
  PathResult result_{};
};

}  // namespace misalign::solver
