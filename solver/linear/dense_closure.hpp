// Solves loop closure at a state by dense elimination with partial pivoting: for the rare sheets
// that the fixed order does not suit, and for equations of another shape (a homotopy's). The last
// null vector is a further row of the Jacobian, which is then regular at limit points too.
#pragma once

#include <cmath>

#include "solver/linear/newton.hpp"

namespace misalign::solver {

/// `Equations` have `double evaluate(geometry, state)`, `residual()` and `jacobian()`, n x (n + 1),
/// the held unknown's column last: those of a ClosureSystem, for instance.
template <class Equations>
class DenseClosure {
 public:
  explicit DenseClosure(Equations& equations)
      : equations_(equations),
        unknowns_(equations.jacobian().cols()),
        bordered_(Eigen::MatrixXd::Zero(unknowns_, unknowns_)),
        lu_(unknowns_),
        rhs_(unknowns_),
        particular_(unknowns_),
        null_(unknowns_),
        border_(Eigen::VectorXd::Unit(unknowns_, unknowns_ - 1)) {}

  void restart(int) { border_ = Eigen::VectorXd::Unit(unknowns_, unknowns_ - 1); }

  double linearize(const SheetGeometry<double>& geometry, const FoldState<double>& state) {
    const double open_by = equations_.evaluate(geometry, state);
    bordered_.topRows(unknowns_ - 1) = equations_.jacobian();
    bordered_.row(unknowns_ - 1) = border_.transpose();
    lu_.factorize(bordered_);
    rhs_ << equations_.residual(), 0;
    particular_ = lu_.solve(rhs_);
    null_ = lu_.solve(Eigen::VectorXd::Unit(unknowns_, unknowns_ - 1));
    if (null_.allFinite()) {
      border_ = null_;
      border_.normalize();
    }
    return open_by;
  }

  void solve(double is_free, double* x, double* null) const {
    Eigen::Map<Eigen::VectorXd>(null, unknowns_) = null_;
    Eigen::Map<Eigen::VectorXd> solution(x, unknowns_);
    solution = particular_;
    if (is_free > 0) return;
    solution -= particular_[unknowns_ - 1] / null_[unknowns_ - 1] * null_;
    solution[unknowns_ - 1] = 0;
  }

  /// det [J; t] has the sign of det [J; border]: their quotient is t . t.
  double orientation() const { return lu_.determinant_sign(); }

 private:
  Equations& equations_;
  const Eigen::Index unknowns_;
  Eigen::MatrixXd bordered_;
  DenseSolve lu_;
  Eigen::VectorXd rhs_, particular_, null_, border_;
};

}  // namespace misalign::solver
