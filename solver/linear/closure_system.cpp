#include "solver/linear/closure_system.hpp"

namespace misalign::solver {

ClosureSystem::ClosureSystem(const Mechanism& mechanism)
    : mechanism_(mechanism),
      entries_(jacobian_entries(mechanism)),
      values_(entries_.size()),
      residual_(mechanism.equations) {}

template <class Geometry>
double ClosureSystem::evaluate_at(const Geometry& geometry, const FoldState<double>& state) {
  is_jacobian_old_ = true;
  return solver::evaluate(mechanism_, geometry, state, residual_.data(), values_.data());
}

double ClosureSystem::evaluate(const SheetGeometry<double>& geometry,
                               const FoldState<double>& state) {
  return evaluate_at(geometry, state);
}

double ClosureSystem::evaluate(const LooseSheet<double>& sheet, const FoldState<double>& state) {
  return evaluate_at(sheet, state);
}

const Eigen::MatrixXd& ClosureSystem::jacobian() const {
  if (jacobian_.size() == 0) jacobian_.setZero(mechanism_.equations, mechanism_.unknowns);
  if (is_jacobian_old_) {
    for (std::size_t k = 0; k < entries_.size(); ++k) {
      jacobian_(entries_[k].row, entries_[k].column) = values_[k];
    }
    is_jacobian_old_ = false;
  }
  return jacobian_;
}

Eigen::VectorXd ClosureSystem::column(int unknown) const {
  Eigen::VectorXd column = Eigen::VectorXd::Zero(mechanism_.equations);
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    if (entries_[k].column == unknown) column[entries_[k].row] = values_[k];
  }
  return column;
}

}  // namespace misalign::solver
