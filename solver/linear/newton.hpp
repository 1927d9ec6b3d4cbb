// Closes loops by Newton-Raphson with the pilot held and dense matrices with partial pivoting, as
// the paper's MATLAB program would.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "solver/kinematics/loop_closure.hpp"
#include "solver/kinematics/loose_sheet.hpp"

namespace misalign::solver {

/// Equations, their Jacobian and its factors at one state; owns its memory from the start.
class ClosureSystem {
 public:
  explicit ClosureSystem(const Mechanism& mechanism);

  /// Residual and Jacobian at `state`; returns the opening of the worst loop.
  double evaluate(const SheetGeometry<double>& geometry, const FoldState<double>& state);
  double evaluate(const LooseSheet<double>& sheet, const FoldState<double>& state);

  const Mechanism& mechanism() const { return mechanism_; }
  const Eigen::VectorXd& residual() const { return residual_; }
  /// equations x unknowns, the pilot's column last.
  const Eigen::MatrixXd& jacobian() const { return jacobian_; }

 private:
  template <class Geometry>
  double evaluate_at(const Geometry& geometry, const FoldState<double>& state);

  const Mechanism& mechanism_;
  std::vector<JacobianEntry> entries_;
  std::vector<double> values_;
  Eigen::VectorXd residual_;
  Eigen::MatrixXd jacobian_;
};

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
  /// x with matrix^T * x = rhs.
  template <class Vector>
  const Eigen::VectorXd& solve_transposed(const Vector& rhs) {
    y_ = rhs;
    lu_.matrixLU().transpose().template triangularView<Eigen::Lower>().solveInPlace(y_);
    lu_.matrixLU().transpose().template triangularView<Eigen::UnitUpper>().solveInPlace(y_);
    x_.noalias() = lu_.permutationP().transpose() * y_;
    return x_;
  }
  /// Solves between arrays of the matrix' size.
  void solve(const double* rhs, double* x) {
    Eigen::Map<Eigen::VectorXd>(x, x_.size()) =
        solve(Eigen::Map<const Eigen::VectorXd>(rhs, x_.size()));
  }
  void solve_transposed(const double* rhs, double* x) {
    Eigen::Map<Eigen::VectorXd>(x, x_.size()) =
        solve_transposed(Eigen::Map<const Eigen::VectorXd>(rhs, x_.size()));
  }
  /// Sign of the determinant: it changes along a path only where the pilot turns.
  int determinant_sign() const;

 private:
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd x_, y_;
};

class Newton {
 public:
  struct Options {
    /// Every loop's rotation (nine entries) and translation (panel widths) within this of closed.
    /// At 1e-8 lengths are off by 8e-7 mm, at 1e-6 verdicts break; rounding leaves 1e-15 to 6e-14
    /// (20 x 20).
    double closure_tolerance = 1e-12;
    /// Three are usual from 1 degree away; a state that needs more than this has lost its branch.
    int max_iterations = 15;
  };

  enum class StopReason {
    converged,       ///< open_by <= closure_tolerance
    too_many_steps,  ///< still open after max_iterations corrections
    not_a_number     ///< the residual is not finite: a singular Jacobian, coordinates out of range
  };

  struct Result {
    StopReason end;
    int iterations;  ///< corrections made
    double open_by;  ///< opening of the returned state
  };

  explicit Newton(const Mechanism& mechanism) : Newton(mechanism, Options{}) {}
  Newton(const Mechanism& mechanism, const Options& options);

  /// Corrects `state` with its pilot crease held. After `converged`, factors() are those of the
  /// last Jacobian that was needed: at the state to first order.
  Result correct(const SheetGeometry<double>& geometry, FoldState<double>& state);

  /// Factors of the square Jacobian (pilot column removed).
  DenseSolve& factors() { return solve_; }

 private:
  Options options_;
  ClosureSystem system_;
  DenseSolve solve_;
  Eigen::VectorXd step_;
};

}  // namespace misalign::solver
