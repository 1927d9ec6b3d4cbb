// Finds lengths, rates of change and the least singular value of a state from factors of its
// Jacobian with pivoting, where the fixed order's are too inaccurate (at 180 degrees pivots
// vanish).
#pragma once

#include <memory>

#include "solver/continuation/path.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "solver/linear/newton.hpp"
#include "solver/linear/singular_value.hpp"

namespace misalign::solver {

/// Pilot angle beyond which the fixed order's factors are not used: at 180 degrees their singular
/// values were off by up to 40 %, and a last correction opened closed loops to 2e-10.
inline constexpr double kPoorFactorsFrom_deg = 179;

/// Largest misfit, J times the tangent from the factors (per radian of pilot), with which these are
/// used; beyond it factors with pivoting are.
inline constexpr double kLargestMisfit = 1e-9;

/// Makes its matrices when they are first needed.
class PivotedState {
 public:
  /// `mechanism` must outlive this object.
  explicit PivotedState(const Mechanism& mechanism);
  ~PivotedState();

  /// Finds all results at a solution; closes an open `state` first, with its pilot held. `state`
  /// may be the point's own.
  void find(const SheetGeometry<double>& geometry, const FoldState<double>& state,
            PathPoint& point);

  double open_by() const { return open_by_; }
  /// Least singular value of the square Jacobian at the last state, whatever was computed before.
  double singular_value();

 private:
  struct Matrices;

  const Mechanism& mechanism_;
  std::unique_ptr<Matrices> matrices_;
  double open_by_ = 0;
};

}  // namespace misalign::solver
