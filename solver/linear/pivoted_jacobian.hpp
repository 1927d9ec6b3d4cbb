// Factors the Jacobian of loop closure with one unknown held, with partial pivoting: dense on small
// sheets, sparse on large ones.
#pragma once

#include <Eigen/SparseLU>
#include <optional>
#include <vector>

#include "solver/linear/closure_system.hpp"
#include "solver/linear/dense_solve.hpp"

namespace misalign::solver {

/// Square factors with an unknown's column left out, the pilot's unless another is held.
class PivotedJacobian {
 public:
  /// Most equations that are factored as a dense matrix. Sparse factors are three times as fast on
  /// 14 x 14 panels (439), and half as fast on 8 x 8 (127).
  static constexpr int kMostDense = 300;
  static bool is_sparse(const Mechanism& mechanism) { return mechanism.equations > kMostDense; }

  /// `system` must outlive this object.
  explicit PivotedJacobian(const ClosureSystem& system);

  /// Factors of the Jacobian at the system's last state. Only sparse ones hold another unknown than
  /// the pilot.
  void factorize() { factorize(system_.mechanism().equations); }
  void factorize(int held);

  /// x with matrix * x = rhs, or with matrix^T * x = rhs; not numbers where it is singular.
  Eigen::VectorXd solve(const Eigen::VectorXd& rhs);
  Eigen::VectorXd solve_transposed(const Eigen::VectorXd& rhs);
  /// The same between arrays of the matrix' size.
  void solve(const double* rhs, double* x) {
    if (dense_) return dense_->solve(rhs, x);
    Map(x, size()) = solve(ConstMap(rhs, size()));
  }
  void solve_transposed(const double* rhs, double* x) {
    Map(x, size()) = solve_transposed(ConstMap(rhs, size()));
  }
  /// Sign of the determinant: it changes along a path only where the held unknown turns.
  int determinant_sign();

 private:
  using Map = Eigen::Map<Eigen::VectorXd>;
  using ConstMap = Eigen::Map<const Eigen::VectorXd>;
  using Sparse = Eigen::SparseMatrix<double>;

  Eigen::Index size() const { return system_.mechanism().equations; }
  void lay_out(int held);

  const ClosureSystem& system_;
  std::optional<DenseSolve> dense_;
  Eigen::SparseLU<Sparse> lu_;
  Sparse matrix_;
  std::vector<std::size_t> value_of_;  // per nonzero of the matrix
  int held_ = -1;
};

}  // namespace misalign::solver
