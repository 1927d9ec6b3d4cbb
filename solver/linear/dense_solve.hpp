// Dense LU factors with partial pivoting.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace misalign::solver {

/// PartialPivLU and a right-hand side of one size, reused without allocating.
class DenseSolve {
 public:
  explicit DenseSolve(Eigen::Index size) : lu_(size), x_(size), y_(size) {}

  template <class Matrix>
  void factorize(const Matrix& matrix) {
    lu_.compute(matrix);
  }
  /// x with matrix * x = rhs.
  template <class Vector>
  const Eigen::VectorXd& solve(const Vector& rhs) {
    x_.noalias() = lu_.permutationP() * rhs;
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(x_);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(x_);
    return x_;
  }
  void solve(const double* rhs, double* x) {
    Eigen::VectorXd::Map(x, x_.size()) = solve(Eigen::VectorXd::Map(rhs, x_.size()));
  }
  /// x with matrix^T * x = rhs.
  template <class Vector>
  const Eigen::VectorXd& solve_transposed(const Vector& rhs) {
    y_ = rhs;
    lu_.matrixLU().transpose().template triangularView<Eigen::Lower>().solveInPlace(y_);
    lu_.matrixLU().transpose().template triangularView<Eigen::UnitUpper>().solveInPlace(y_);
    x_.noalias() = lu_.permutationP().transpose() * y_;
    return x_;
  }
  /// Sign of the determinant: it changes along a path only where the pilot turns.
  int determinant_sign() const {
    const auto diagonal = lu_.matrixLU().diagonal();
    int sign = static_cast<int>(lu_.permutationP().determinant());
    for (Eigen::Index k = 0; k < diagonal.size(); ++k) {
      if (diagonal[k] < 0) sign = -sign;
    }
    return sign;
  }

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd x_, y_;
};

}  // namespace misalign::solver
