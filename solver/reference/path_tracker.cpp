#include "solver/reference/path_tracker.hpp"

namespace misalign::solver {
namespace {

// A crease that moves over 20 degrees in one step has jumped to another branch: sin(10 degrees).
// Unjumped 1-degree steps move a crease by 1 to 3 degrees, more only within 0.1 of a fold limit.
constexpr double kJumpHalfSine = 0.17364817766693033;

}  // namespace

PathTracker::PathTracker(const Mechanism& mechanism)
    : newton_(mechanism),
      arc_length_(mechanism),
      pilot_(mechanism.pilot),
      state_(flat_state<double>(mechanism)),
      trial_(state_) {}

void PathTracker::begin(const PathPlan& plan) {
  state_ = plan.start;
  forward_sign_ = 0;
  result_ = {};
}

bool PathTracker::advance_to(const SheetGeometry<double>& geometry, const Station& station) {
  if (!step_to(geometry, station)) {
    if (forward_sign_ == 0) {
      result_.end = PathEnd::start_lost;
      return false;
    }
    const ArcLength::Result arc =
        arc_length_.walk(geometry, station.pilot, forward_sign_, newton_, state_);
    result_.arc_steps += arc.steps;
    if (arc.end == ArcLength::End::turned) {
      result_.end = PathEnd::fold_limit;
      result_.fold_limit_deg = arc.limit_deg;
      return false;
    }
    if (arc.end == ArcLength::End::stalled) {
      result_.end = PathEnd::stalled;
      return false;
    }
  }
  result_.fold_limit_deg = station.pilot_deg;
  return true;
}

// Corrects the solution before by Newton's method with the pilot held; refuses one that left this
// half of the curve.
bool PathTracker::step_to(const SheetGeometry<double>& geometry, const Station& station) {
  trial_ = state_;
  trial_.creases[pilot_] = station.pilot;
  const Newton::Result newton = newton_.correct(geometry, trial_);
  ++result_.newton_solves;
  result_.newton_iterations += newton.iterations;
  if (newton.end != Newton::StopReason::converged) return false;
  if (largest_half_sine(state_, trial_) > kJumpHalfSine) return false;
  const int sign = newton_.factors().determinant_sign();
  if (forward_sign_ == 0) forward_sign_ = sign;
  if (sign != forward_sign_) return false;
  std::swap(state_, trial_);
  return true;
}

}  // namespace misalign::solver
