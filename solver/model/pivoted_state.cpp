#include "solver/model/pivoted_state.hpp"

#include <cassert>

namespace misalign::solver {

struct PivotedState::Matrices {
  explicit Matrices(const Mechanism& mechanism)
      : system(mechanism),
        newton(mechanism),
        factors(system),
        smallest(mechanism.equations),
        misfit(mechanism.equations) {}

  ClosureSystem system;
  Newton newton;
  PivotedJacobian factors;
  SmallestSingularValue<double> smallest;
  FoldState<double> trial;
  Eigen::VectorXd misfit;
};

PivotedState::PivotedState(const Mechanism& mechanism) : mechanism_(mechanism) {}

PivotedState::~PivotedState() = default;

void PivotedState::find(const SheetGeometry<double>& geometry, const FoldState<double>& state,
                        PathPoint& point) {
  assert(state.creases.size() == mechanism_.creases.size());
  if (!matrices_) matrices_ = std::make_unique<Matrices>(mechanism_);
  auto& [system, newton, factors, smallest, trial, misfit] = *matrices_;
  point.state = state;
  open_by_ = system.evaluate(geometry, point.state);
  if (open_by_ > Newton::Options{}.closure_tolerance) {
    trial = point.state;
    if (newton.correct(geometry, trial).end == Newton::StopReason::converged) point.state = trial;
    open_by_ = system.evaluate(geometry, point.state);
  }
  factors.factorize();
  point.rates.resize(static_cast<std::size_t>(mechanism_.unknowns));
  auto rates = Eigen::VectorXd::Map(point.rates.data(), mechanism_.unknowns);
  rates.head(mechanism_.equations) = -factors.solve(system.column(mechanism_.equations));
  rates[mechanism_.equations] = 1;  // the pilot's rate, last
  point.pilot_rate = 1 / rates.norm();
  folded_lengths_and_slopes(mechanism_, geometry, point.state, point.rates.data(),
                            point.lengths.data(), point.slopes.data(), misfit.data());
  point.misfit = misfit.cwiseAbs().maxCoeff();
}

double PivotedState::singular_value() {
  matrices_->smallest.restart(0);
  return matrices_->smallest.of(matrices_->factors);
}

}  // namespace misalign::solver
