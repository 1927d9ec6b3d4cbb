#include "solver/continuation/homotopy.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace misalign::solver {
namespace {

constexpr double kClosure = NewtonOptions{}.closure_tolerance;
constexpr int kMostCorrections = 8;

// Steps in the share of the shifts; below the shortest the branch is likely to turn.
constexpr double kFirstStep = 0.1, kShortestStep = 1e-3;

// Creases at the first stop may turn by this share of the pilot's own angle from one step to the
// next: what goes farther has left the branch.
constexpr double kLongestTurn = 0.5;

// Of the walk, in joint angles measured by the pilot's and in shares together.
constexpr double kLongestWalkStep = 0.05, kShortestWalkStep = 1e-7;
constexpr int kMostWalkSteps = 2000;

// For the residual's rate of change with the share: error 1e-10 of it, which only bends the
// tangent.
constexpr double kDifference = 1e-5;

}  // namespace

StartFinder::StartFinder(const Mechanism& mechanism, const Elimination& elimination,
                         const PathPlan& plan, const FlatVertices& base_vertices_mm)
    : mechanism_(mechanism),
      plan_(plan),
      base_vertices_mm_(base_vertices_mm),
      lu_(elimination),
      entries_(jacobian_entries(mechanism)),
      residual_(mechanism.equations),
      other_residual_(mechanism.equations),
      values_(entries_.size()),
      y_(mechanism.unknowns),
      turn_(mechanism.unknowns),
      move_(mechanism.unknowns),
      last_move_(mechanism.unknowns) {}

StartFinder::~StartFinder() = default;

StartEnd StartFinder::find(const FlatVertices& vertices_mm) {
  shifts_mm_ = vertices_mm - base_vertices_mm_;
  state_ = trial_ = plan_.start;
  branch_sign_ = 0;
  if (!correct(0)) return StartEnd::lost;
  std::fill(last_move_.begin(), last_move_.end(), 0.0);
  double share = 0, last_step = 1;
  for (double step = kFirstStep; share < 1;) {
    step = std::min(step, 1 - share);
    for (std::size_t k = 0; k < move_.size(); ++k) move_[k] = last_move_[k] * step / last_step;
    trial_ = state_;
    advance(mechanism_, move_.data(), trial_);
    if (correct(share + step)) {
      state_ = trial_;
      share += step;
      last_step = step;
      last_move_ = move_;
      step *= 2;
    } else {
      step *= 0.5;
      if (step < kShortestStep) return walk(share);
    }
  }
  return StartEnd::found;
}

// Residual and Jacobian of the sheet with this share of its shifts, into residual_ and lu_.
double StartFinder::evaluate_at(double share, const FoldState<double>& state) {
  vertices_mm_ = base_vertices_mm_ + share * shifts_mm_;
  place(mechanism_, vertices_mm_, geometry_);
  return evaluate(mechanism_, geometry_, state, residual_.data(), lu_.entries());
}

// Newton's method from `trial_`; adds to `move_` what it turns.
bool StartFinder::correct(double share) {
  for (int k = 0;; ++k) {
    const double open = evaluate_at(share, trial_);
    lu_.factorize();
    if (open <= kClosure) break;
    if (k == kMostCorrections || !std::isfinite(open)) return false;
    lu_.forward(residual_.data(), y_.data());
    lu_.backward(y_.data(), y_[mechanism_.equations - 1] / lu_.partner_coefficient(), 0.0,
                 turn_.data());
    for (double& turn : turn_) turn = -turn;
    advance(mechanism_, turn_.data(), trial_);
    std::transform(turn_.begin(), turn_.end(), move_.begin(), move_.begin(), std::plus<>());
  }
  const int sign = lu_.determinant_sign() < 0 ? -1 : 1;
  if (branch_sign_ == 0) branch_sign_ = sign;
  return sign == branch_sign_ &&
         largest_half_sine(state_, trial_) <= kLongestTurn * plan_.stops.front().pilot.s;
}

// By pseudo-arclength in the joints and the share together, from `state_` on: until the share
// turns, or is whole.
StartEnd StartFinder::walk(double share) {
  const Eigen::Index n = mechanism_.equations;
  const double unit_rad = 2 * plan_.stops.front().pilot.s;  // joints count by it
  bordered_.resize(n + 1, n + 1);
  if (!solve_) solve_ = std::make_unique<DenseSolve>(n + 1);
  rhs_.resize(n + 1);
  tangent_ = Eigen::VectorXd::Unit(n + 1, n);
  trial_ = state_;
  if (!find_tangent(share)) return StartEnd::lost;
  double ds = 0.1 * kLongestWalkStep;
  for (int steps = 0; steps < kMostWalkSteps && ds > kShortestWalkStep; ++steps) {
    trial_ = state_;
    double at = share;
    step_ = ds * tangent_;
    bool is_closed = false;
    for (int k = 0; k <= kMostCorrections && !is_closed; ++k) {
      for (Eigen::Index j = 0; j < n; ++j) turn_[j] = step_[j] * unit_rad;
      turn_[n] = 0;
      advance(mechanism_, turn_.data(), trial_);
      at += step_[n];
      is_closed = evaluate_at(at, trial_) <= kClosure;
      if (is_closed) break;
      rhs_.head(n) = -Eigen::Map<const Eigen::VectorXd>(residual_.data(), n);
      rhs_[n] = 0;
      step_ = solve_->solve(rhs_);
      if (!step_.allFinite() || step_.cwiseAbs().maxCoeff() > 1) break;
    }
    last_tangent_ = tangent_;
    if (!is_closed || !find_tangent(at) || tangent_.dot(last_tangent_) < 0.9) {
      tangent_ = last_tangent_;
      trial_ = state_;
      find_tangent(share);
      ds *= 0.5;
      continue;
    }
    if (tangent_[n] <= 0) return StartEnd::branch_ended;
    state_ = trial_;
    share = at;
    if (share >= 1) {
      std::fill(move_.begin(), move_.end(), 0.0);
      const bool landed = correct(1);
      state_ = trial_;
      return landed ? StartEnd::found : StartEnd::lost;
    }
    ds = std::min(1.5 * ds, kLongestWalkStep);
  }
  return StartEnd::lost;
}

// The bordered matrix at `trial_`, and from it the unit tangent that goes on as `tangent_` does.
bool StartFinder::find_tangent(double share) {
  const Eigen::Index n = mechanism_.equations;
  const double unit_rad = 2 * plan_.stops.front().pilot.s;
  evaluate_at(share - kDifference, trial_);
  other_residual_ = residual_;
  evaluate_at(share + kDifference, trial_);
  bordered_.setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    bordered_(i, n) = (residual_[i] - other_residual_[i]) / (2 * kDifference);
  }
  vertices_mm_ = base_vertices_mm_ + share * shifts_mm_;
  place(mechanism_, vertices_mm_, geometry_);
  evaluate(mechanism_, geometry_, trial_, residual_.data(), values_.data());
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    if (entries_[e].column < n) {
      bordered_(entries_[e].row, entries_[e].column) = values_[e] * unit_rad;
    }
  }
  bordered_.row(n) = tangent_;
  solve_->factorize(bordered_);
  rhs_.setZero();
  rhs_[n] = 1;
  const Eigen::VectorXd& next = solve_->solve(rhs_);
  if (!next.allFinite()) return false;
  tangent_ = next / next.norm();
  bordered_.row(n) = tangent_;
  solve_->factorize(bordered_);
  return true;
}

}  // namespace misalign::solver
