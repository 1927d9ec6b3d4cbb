// Solves loop closure at a state by elimination with partial pivoting: for the rare sheets that the
// fixed order does not suit.
#pragma once

#include <optional>

#include "solver/kinematics/fold_state.hpp"
#include "solver/linear/pivoted_jacobian.hpp"

namespace misalign::solver {

/// A further row makes the Jacobian regular at limit points, too. On small sheets, whose matrices
/// are dense, it is the last null vector; on large ones, to keep the matrix sparse, it holds the
/// unknown that moves fastest.
/// `Equations` are a ClosureSystem with `double evaluate(geometry, state)`.
template <class Equations>
class PivotedClosure {
 public:
  /// `equations` must outlive this object.
  explicit PivotedClosure(Equations& equations)
      : equations_(equations),
        unknowns_(equations.mechanism().unknowns),
        particular_(unknowns_),
        null_(unknowns_) {
    if (PivotedJacobian::is_sparse(equations.mechanism())) {
      held_column_ = std::make_unique<PivotedJacobian>(equations);
    } else {
      bordered_.emplace(unknowns_);
    }
    restart(0);
  }

  /// Begins a new path.
  void restart(int) {
    if (bordered_) bordered_->border = Eigen::VectorXd::Unit(unknowns_, unknowns_ - 1);
    held_ = next_held_ = unknowns_ - 1;
  }

  /// Residual and factors at `state`; returns the opening of the worst loop.
  double linearize(const SheetGeometry<double>& geometry, const FoldState<double>& state) {
    const double open_by = equations_.evaluate(geometry, state);
    if (bordered_) {
      factorize_bordered();
    } else {
      factorize_held();
    }
    return open_by;
  }

  /// Finds x with J x = residual and `null` with J null = 0, as SparseClosure does.
  void solve(double is_free, double* x, double* null) const {
    Eigen::Map<Eigen::VectorXd>(null, unknowns_) = null_;
    Eigen::Map<Eigen::VectorXd> solution(x, unknowns_);
    solution = particular_;
    if (is_free > 0) return;
    solution -= particular_[unknowns_ - 1] / null_[unknowns_ - 1] * null_;
    solution[unknowns_ - 1] = 0;
  }

  /// Sign of det [J; t] for the null vector t of `solve`: that of det [J; row], since their
  /// quotient is t . t. A row that holds an unknown leaves the cofactor of its place.
  double orientation() {
    if (bordered_) return bordered_->lu.determinant_sign();
    const bool is_even = (unknowns_ - 1 + held_) % 2 == 0;
    return is_even ? held_column_->determinant_sign() : -held_column_->determinant_sign();
  }

 private:
  // Share of the fastest rate below which another unknown is held: each change is another order of
  // elimination.
  static constexpr double kSlow = 0.1;

  struct Bordered {
    explicit Bordered(Eigen::Index unknowns)
        : matrix(Eigen::MatrixXd::Zero(unknowns, unknowns)), lu(unknowns), rhs(unknowns) {}

    Eigen::MatrixXd matrix;
    DenseSolve lu;
    Eigen::VectorXd rhs, border;
  };

  void factorize_bordered() {
    auto& [matrix, lu, rhs, border] = *bordered_;
    matrix.topRows(unknowns_ - 1) = equations_.jacobian();
    matrix.row(unknowns_ - 1) = border.transpose();
    lu.factorize(matrix);
    rhs << equations_.residual(), 0;
    particular_ = lu.solve(rhs);
    null_ = lu.solve(Eigen::VectorXd::Unit(unknowns_, unknowns_ - 1));
    if (!null_.allFinite()) return;
    border = null_;
    border.normalize();
  }

  void factorize_held() {
    held_ = next_held_;
    held_column_->factorize(static_cast<int>(held_));
    const auto insert = [&](double value, const Eigen::VectorXd& others, Eigen::VectorXd& all) {
      all << others.head(held_), value, others.tail(others.size() - held_);
    };
    insert(0, held_column_->solve(equations_.residual()), particular_);
    insert(1, -held_column_->solve(equations_.column(static_cast<int>(held_))), null_);
    Eigen::Index fastest;
    if (null_.allFinite() && null_.cwiseAbs().maxCoeff(&fastest) * kSlow > 1) next_held_ = fastest;
  }

  Equations& equations_;
  const Eigen::Index unknowns_;
  std::optional<Bordered> bordered_;              // on small sheets
  std::unique_ptr<PivotedJacobian> held_column_;  // on large ones
  Eigen::VectorXd particular_, null_;
  Eigen::Index held_ = 0, next_held_ = 0;
};

}  // namespace misalign::solver
