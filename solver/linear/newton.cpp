#include "solver/linear/newton.hpp"

#include <cassert>

namespace misalign::solver {

Newton::Newton(const Mechanism& mechanism, const Options& options)
    : options_(options),
      system_(mechanism),
      factors_(system_),
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
    factors_.factorize();
    factors_.solve(system_.residual().data(), step_.data());
    step_.head(mechanism.equations) *= -1;
    advance(mechanism, step_.data(), state);  // the pilot's entry, the last, stays zero
  }
}

}  // namespace misalign::solver
