#include "solver/reference/arc_length.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::solver {
namespace {

// Steps are Euclidean norms over all unknowns; below the shortest the walk has stalled.
constexpr double kLongestStep_rad = 0.1, kShortestStep_rad = 1e-9;
constexpr int kMaxSteps = 5000, kMaxCorrections = 8;
// 15 degrees between the tangents of neighbouring points.
constexpr double kLeastTangentCosine = 0.966;
// The pilot's largest value is exact to 6e-8 degrees; 0.001 is required.
constexpr double kTurnTolerance_rad = 1e-9;

}  // namespace

ArcLength::ArcLength(const Mechanism& mechanism)
    : system_(mechanism),
      solve_(mechanism.unknowns),
      bordered_(mechanism.unknowns, mechanism.unknowns),
      rhs_(mechanism.unknowns),
      step_(mechanism.unknowns),
      tangent_(mechanism.unknowns),
      next_tangent_(mechanism.unknowns),
      trial_(flat_state<double>(mechanism)),
      landing_(trial_) {}

ArcLength::Result ArcLength::walk(const SheetGeometry<double>& geometry,
                                  const HalfAngle<double>& target, int forward_sign, Newton& newton,
                                  FoldState<double>& state) {
  const Mechanism& mechanism = system_.mechanism();
  const int pilot = mechanism.pilot;
  const Eigen::Index p = mechanism.unknowns - 1;

  system_.evaluate(geometry, state);
  next_tangent_.setZero();
  next_tangent_[p] = 1;
  update_tangent(next_tangent_, tangent_);
  orientation_ = solve_.determinant_sign();
  const double gap = 2 * half_sine_between(target, state.creases[pilot]);
  double ds = std::min(kLongestStep_rad, 0.5 * gap / tangent_[p]);
  double bend = 0;  // fall of the tangent's pilot entry per unit of length, once a turn was passed

  for (int steps = 1; steps <= kMaxSteps; ++steps) {
    if (bend > 0 && ds * tangent_[p] < kTurnTolerance_rad) {
      const double limit = angle_deg(state.creases[pilot]) + 0.5 * ds * tangent_[p] / kRadPerDeg;
      return {End::turned, limit, steps};
    }
    if (ds < kShortestStep_rad) return {End::stalled, 0, steps};
    if (!step(geometry, state, ds)) {
      ds *= 0.5;
      continue;
    }
    if (half_sine_between(trial_.creases[pilot], target) >= 0) {
      if (land(geometry, target, forward_sign, ds, state, newton)) {
        state = landing_;
        return {End::reached, 0, steps};
      }
      ds *= 0.5;
      continue;
    }
    if (next_tangent_[p] <= 0) {
      if (ds * std::max(tangent_[p], -next_tangent_[p]) < kTurnTolerance_rad) {
        return {End::turned, angle_deg(state.creases[pilot]), steps};
      }
      bend = (tangent_[p] - next_tangent_[p]) / ds;
      ds = std::clamp(tangent_[p] / bend, 0.1 * ds, 0.9 * ds);
      continue;
    }
    std::swap(state, trial_);
    std::swap(tangent_, next_tangent_);
    ds = bend > 0 ? tangent_[p] / bend : std::min(1.5 * ds, kLongestStep_rad);
  }
  return {End::stalled, 0, kMaxSteps};
}

// Steps from `from` by `ds` along tangent_ to the next point of the same curve, trial_, with its
// tangent in next_tangent_; false if the step was too long. The bordered determinant keeps its sign
// along one curve, also round a turn: a change tells that the step crossed to another branch.
bool ArcLength::step(const SheetGeometry<double>& geometry, const FoldState<double>& from,
                     double ds) {
  trial_ = from;
  step_ = ds * tangent_;
  advance(system_.mechanism(), step_.data(), trial_);
  if (!correct(geometry)) return false;
  update_tangent(tangent_, next_tangent_);
  return solve_.determinant_sign() == orientation_ &&
         tangent_.dot(next_tangent_) >= kLeastTangentCosine;
}

// Newton on trial_ in the plane across tangent_; leaves the Jacobian of the solution in system_.
bool ArcLength::correct(const SheetGeometry<double>& geometry) {
  const Mechanism& mechanism = system_.mechanism();
  double last_open = 0;
  for (int k = 0; k <= kMaxCorrections; ++k) {
    const double open = system_.evaluate(geometry, trial_);
    if (!system_.residual().allFinite()) return false;
    if (open <= Newton::Options{}.closure_tolerance) return true;
    if (k > 1 && open > last_open) return false;
    last_open = open;
    bordered_.topRows(mechanism.equations) = system_.jacobian();
    bordered_.row(mechanism.equations) = tangent_.transpose();
    solve_.factorize(bordered_);
    rhs_.head(mechanism.equations) = -system_.residual();
    rhs_[mechanism.equations] = 0;
    advance(mechanism, solve_.solve(rhs_).data(), trial_);
  }
  return false;
}

// The unit null vector of the Jacobian in system_ on the side of `border`.
void ArcLength::update_tangent(const Eigen::VectorXd& border, Eigen::VectorXd& tangent) {
  const int equations = system_.mechanism().equations;
  bordered_.topRows(equations) = system_.jacobian();
  bordered_.row(equations) = border.transpose();
  solve_.factorize(bordered_);
  rhs_.setZero();
  rhs_[equations] = 1;
  tangent = solve_.solve(rhs_);
  tangent.normalize();
}

// The solution with the pilot at `target`, between `from` and trial_ (`step` apart); in landing_.
bool ArcLength::land(const SheetGeometry<double>& geometry, const HalfAngle<double>& target,
                     int forward_sign, double step, const FoldState<double>& from, Newton& newton) {
  const Mechanism& mechanism = system_.mechanism();
  const HalfAngle<double>& start = from.creases[mechanism.pilot];
  const double share =
      half_sine_between(target, start) / half_sine_between(trial_.creases[mechanism.pilot], start);
  landing_ = from;
  step_ = share * step * tangent_;
  advance(mechanism, step_.data(), landing_);
  landing_.creases[mechanism.pilot] = target;
  if (newton.correct(geometry, landing_).end != Newton::StopReason::converged) return false;
  return newton.factors().determinant_sign() == forward_sign &&
         largest_half_sine(from, landing_) <= step;
}

double largest_half_sine(const FoldState<double>& a, const FoldState<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.creases.size(); ++i) {
    largest = std::max(largest, std::abs(half_sine_between(a.creases[i], b.creases[i])));
  }
  return largest;
}

}  // namespace misalign::solver
