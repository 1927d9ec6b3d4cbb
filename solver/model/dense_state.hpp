// Lengths, rates of change and the least singular value of a state, from dense factors of its
// Jacobian: used where sparse factors are too inaccurate (at 180 degrees pivots vanish).
#pragma once

#include <memory>

#include "solver/continuation/path.hpp"
#include "solver/kinematics/diagonals.hpp"
#include "solver/linear/newton.hpp"
#include "solver/linear/singular_value.hpp"

namespace misalign::solver {

/// From here on the fixed order's factors are not trusted: at 180 degrees singular values from them
/// were off by up to 40 %, and closed loops were opened to 2e-10 by a last correction.
inline constexpr double kPoorFactorsFrom_deg = 179;

/// J times the tangent that factors give is zero but for what they are worth: beyond this (per
/// radian of pilot) what follows from them is asked of dense ones.
inline constexpr double kLargestMisfit = 1e-9;

/// Its matrices are made when first needed.
class DenseState {
 public:
  /// `mechanism` must outlive this object.
  explicit DenseState(const Mechanism& mechanism);
  ~DenseState();

  /// Everything about a solution, or what is near one: closes it first, its pilot held, if it is
  /// open. `state` may be the point's own.
  void find(const SheetGeometry<double>& geometry, const FoldState<double>& state,
            PathPoint& point);

  double open_by() const { return open_by_; }
  /// The least of the square Jacobian's there, whatever was asked before.
  double singular_value();

 private:
  struct Matrices;

  const Mechanism& mechanism_;
  std::unique_ptr<Matrices> matrices_;
  double open_by_ = 0;
};

}  // namespace misalign::solver
