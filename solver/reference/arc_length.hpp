// Pseudo-arclength continuation (Keller; Allgower & Georg, Introduction to Numerical Continuation
// Methods, ch. 6): where holding the pilot fails, walk along the curve itself, so that a turning
// point of the pilot is told from a solver that lost its way.
#pragma once

#include "solver/linear/newton.hpp"

namespace misalign::solver {

struct ArcLengthOptions {
  double longest_step_rad = 0.1;        ///< Euclidean norm over all unknowns
  double shortest_step_rad = 1e-9;      ///< below it the walk has stalled
  double least_tangent_cosine = 0.966;  ///< 15 degrees between the tangents of neighbouring points
  int max_corrections = 8;
  int max_steps = 5000;
  /// How well the pilot's largest value is known: 6e-8 degrees; 0.001 is asked for.
  double turn_tolerance_rad = 1e-9;
};

class ArcLength {
 public:
  enum class End {
    reached,  ///< the pilot came to the target
    turned,   ///< the pilot's tangent changed sign before it
    stalled   ///< steps shorter than shortest_step_rad, or more than max_steps
  };

  struct Result {
    End end;
    double limit_deg;  ///< the pilot's largest angle if it turned
    int steps;
  };

  explicit ArcLength(const Mechanism& mechanism, const ArcLengthOptions& options = {});

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

  ArcLengthOptions options_;
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
