// Pseudo-arclength continuation (Keller; Allgower & Georg, Introduction to Numerical Continuation
// Methods, ch. 6): where holding the pilot fails, it walks along the curve itself, which tells a
// turning point of the pilot from a solver that lost its path.
#pragma once

#include "solver/linear/newton.hpp"

namespace misalign::solver {

class ArcLength {
 public:
  enum class End {
    reached,  ///< the pilot came to the target
    turned,   ///< the pilot's tangent changed sign before it
    stalled   ///< steps became too short, or too many
  };

  struct Result {
    End end;
    double limit_deg;  ///< the pilot's largest angle if it turned
    int steps;
  };

  explicit ArcLength(const Mechanism& mechanism);

  /// Walks from `state`, a solution whose pilot is below `target`, in the direction of growing
  /// pilot. `forward_sign` is the determinant's sign on this half of the curve; `newton` lands on
  /// the target. On `reached` `state` is the solution there, otherwise the last one on the forward
  /// half.
  Result walk(const SheetGeometry<double>& geometry, const HalfAngle<double>& target,
              int forward_sign, Newton& newton, FoldState<double>& state);

 private:
  bool step(const SheetGeometry<double>& geometry, const FoldState<double>& from, double ds);
  bool correct(const SheetGeometry<double>& geometry);
  void update_tangent(const Eigen::VectorXd& border, Eigen::VectorXd& tangent);
  bool land(const SheetGeometry<double>& geometry, const HalfAngle<double>& target,
            int forward_sign, double step, const FoldState<double>& from, Newton& newton);

  ClosureSystem system_;
  DenseSolve solve_;
  Eigen::MatrixXd bordered_;
  Eigen::VectorXd rhs_, step_, tangent_, next_tangent_;
  int orientation_ = 0;  // sign of the bordered determinant on the curve being walked
  FoldState<double> trial_, landing_;
};

/// Largest |sin(half the change)| of any crease between two states.
double largest_half_sine(const FoldState<double>& a, const FoldState<double>& b);

}  // namespace misalign::solver
