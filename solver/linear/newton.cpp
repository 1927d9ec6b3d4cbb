#include "solver/linear/newton.hpp"

#include <cassert>

namespace misalign::solver {

ClosureSystem::ClosureSystem(const Mechanism& mechanism)
    : mechanism_(mechanism),
      entries_(jacobian_entries(mechanism)),
      values_(entries_.size()),
      residual_(mechanism.equations),
      jacobian_(Eigen::MatrixXd::Zero(mechanism.equations, mechanism.unknowns)) {}

template <class Geometry>
double ClosureSystem::evaluate_at(const Geometry& geometry, const FoldState<double>& state) {
  const double open =
      solver::evaluate(mechanism_, geometry, state, residual_.data(), values_.data());
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    jacobian_(entries_[k].row, entries_[k].column) = values_[k];
  }
  return open;
}

double ClosureSystem::evaluate(const SheetGeometry<double>& geometry,
                               const FoldState<double>& state) {
  return evaluate_at(geometry, state);
}

double ClosureSystem::evaluate(const LooseSheet<double>& sheet, const FoldState<double>& state) {
  return evaluate_at(sheet, state);
}

int DenseSolve::determinant_sign() const {
  const auto diagonal = lu_.matrixLU().diagonal();
  int sign = static_cast<int>(lu_.permutationP().determinant());
  for (Eigen::Index k = 0; k < diagonal.size(); ++k) {
    if (diagonal[k] < 0) sign = -sign;
  }
  return sign;
}

Newton::Newton(const Mechanism& mechanism, const Options& options)
    : options_(options),
      system_(mechanism),
      solve_(mechanism.equations),
      step_(Eigen::VectorXd::Zero(mechanism.unknowns)) {}

Newton::Result Newton::correct(const SheetGeometry<double>& geometry, FoldState<double>& state) {
  const Mechanism& mechanism = system_.mechanism();
  assert(state.creases.size() == mechanism.creases.size());
  assert(state.balls.size() == mechanism.balls.size());
  for (int iteration = 0;; ++iteration) {
    const double open = system_.evaluate(geometry, state);
    if (!system_.residual().allFinite()) return {StopReason::not_a_number, iteration, open};
    if (open <= options_.closure_tolerance && iteration > 0) {
      return {StopReason::converged, iteration, open};
    }
    if (iteration == options_.max_iterations) return {StopReason::too_many_steps, iteration, open};
    solve_.factorize(system_.jacobian().leftCols(mechanism.equations));
    step_.head(mechanism.equations) = -solve_.solve(system_.residual());
    advance(mechanism, step_.data(), state);  // the pilot's entry, the last, stays zero
  }
}

}  // namespace misalign::solver
