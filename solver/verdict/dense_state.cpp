#include "solver/verdict/dense_state.hpp"

namespace misalign::solver {

DenseLook::DenseLook(const Mechanism& mechanism)
    : mechanism_(mechanism),
      system_(mechanism),
      newton_(mechanism),
      factors_(mechanism.equations),
      smallest_(mechanism.equations),
      rates_(mechanism.unknowns),
      misfit_(mechanism.equations),
      lengths_(mechanism.diagonals.size()),
      slopes_(mechanism.diagonals.size()) {}

DenseLook::~DenseLook() = default;

void DenseLook::at(const SheetGeometry<double>& geometry, const FoldState<double>& state) {
  state_ = state;
  open_by_ = system_.evaluate(geometry, state_);
  if (open_by_ > NewtonOptions{}.closure_tolerance) {
    trial_ = state;
    if (newton_.correct(geometry, trial_).end == NewtonEnd::converged) state_ = trial_;
    open_by_ = system_.evaluate(geometry, state_);
  }
  factors_.factorize(system_.jacobian().leftCols(mechanism_.equations));
  singular_value_ = smallest_.of(factors_);
  Eigen::Map<Eigen::VectorXd> rates(rates_.data(), mechanism_.unknowns);
  rates.head(mechanism_.equations) = -factors_.solve(system_.jacobian().col(mechanism_.equations));
  rates[mechanism_.equations] = 1;  // the pilot's, last
  pilot_rate_ = 1 / rates.norm();
  folded_lengths_and_slopes(mechanism_, geometry, state_, rates_.data(), lengths_.data(),
                            slopes_.data(), misfit_.data());
}

}  // namespace misalign::solver
