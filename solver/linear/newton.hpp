// Closes loops by Newton-Raphson with the pilot held and matrices with partial pivoting, as the
// paper's MATLAB program would.
#pragma once

#include "solver/linear/pivoted_jacobian.hpp"

namespace misalign::solver {

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
  PivotedJacobian& factors() { return factors_; }

 private:
  Options options_;
  ClosureSystem system_;
  PivotedJacobian factors_;
  Eigen::VectorXd step_;
};

}  // namespace misalign::solver
