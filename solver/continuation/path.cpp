#include "solver/continuation/path.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

// A quotient this close below a whole number, relative, is that number: 170.3 / 0.1.
constexpr double kWholeMultiple = 1e-9;

// Angles closer than this are one stop: far below any sample_deg, far above rounding.
constexpr double kSameAngle_deg = 1e-9;

}  // namespace

PathPlan plan_path(const Mechanism& mechanism, const BaseFolding& folding,
                   const FlatVertices& base_vertices_mm, const PathPlanOptions& options) {
  PathPlan plan;
  const auto add_multiples = [&](double step_deg, bool visit, bool sampled) {
    const int count = static_cast<int>(options.end_deg / step_deg * (1 + kWholeMultiple));
    for (int k = 1; k <= count; ++k) {
      const double angle_deg = std::min(k * step_deg, options.end_deg);
      plan.stops.push_back({angle_deg, {}, sampled ? k : 0, visit});
    }
  };
  add_multiples(options.sample_deg, true, true);
  if (options.look_deg > 0) add_multiples(options.look_deg, true, false);
  if (options.sample_deg > options.longest_step_deg) {
    add_multiples(options.longest_step_deg, false, false);
  }
  plan.stops.push_back({options.end_deg, {}, 0, true});
  // Of equal angles the sample comes first and stays.
  std::stable_sort(plan.stops.begin(), plan.stops.end(), [](const Stop& a, const Stop& b) {
    return a.pilot_deg < b.pilot_deg - kSameAngle_deg;
  });
  plan.stops.erase(std::unique(plan.stops.begin(), plan.stops.end(),
                               [](const Stop& a, const Stop& b) {
                                 return b.pilot_deg - a.pilot_deg <= kSameAngle_deg;
                               }),
                   plan.stops.end());
  for (Stop& stop : plan.stops) stop.pilot = half_angle_of_deg(stop.pilot_deg);
  plan.start = base_state(mechanism, folding, base_vertices_mm, plan.stops.front().pilot);
  return plan;
}

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

bool PathTracker::advance_to(const SheetGeometry<double>& geometry, const Stop& stop) {
  if (!step_to(geometry, stop)) {
    if (forward_sign_ == 0) {
      result_.end = PathEnd::start_lost;
      return false;
    }
    const ArcResult arc = arc_length_.walk(geometry, stop.pilot, forward_sign_, newton_, state_);
    result_.arc_steps += arc.steps;
    if (arc.end == ArcEnd::turned) {
      result_.end = PathEnd::fold_limit;
      result_.fold_limit_deg = arc.limit_deg;
      return false;
    }
    if (arc.end == ArcEnd::stalled) {
      result_.end = PathEnd::stalled;
      return false;
    }
  }
  result_.fold_limit_deg = stop.pilot_deg;
  return true;
}

// Newton with the pilot held, from the solution before; refused where it left this half of the
// curve.
bool PathTracker::step_to(const SheetGeometry<double>& geometry, const Stop& stop) {
  trial_ = state_;
  trial_.creases[pilot_] = stop.pilot;
  const NewtonResult newton = newton_.correct(geometry, trial_);
  ++result_.newton_solves;
  result_.newton_iterations += newton.iterations;
  if (newton.end != NewtonEnd::converged) return false;
  if (largest_half_sine(state_, trial_) > kJumpHalfSine) return false;
  const int sign = newton_.factors().determinant_sign();
  if (forward_sign_ == 0) forward_sign_ = sign;
  if (sign != forward_sign_) return false;
  std::swap(state_, trial_);
  return true;
}

}  // namespace misalign::solver
