// What a state says beyond its own numbers, from dense factors of its Jacobian: the yardstick of
// the fixed order's, and the way out where that order does not suit (at 180 degrees its
// pivots vanish).
#pragma once

#include <vector>

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

class DenseLook {
 public:
  explicit DenseLook(const Mechanism& mechanism);
  ~DenseLook();

  /// Looks at a solution, or what is near one: closes it first, its pilot held, if it is open.
  void at(const SheetGeometry<double>& geometry, const FoldState<double>& state);

  const FoldState<double>& state() const { return state_; }  ///< closed

  double open_by() const { return open_by_; }
  double singular_value() const { return singular_value_; }
  const std::vector<double>& lengths() const { return lengths_; }  ///< panel widths
  const std::vector<double>& slopes() const { return slopes_; }    ///< per radian of pilot
  double pilot_rate() const { return pilot_rate_; }  ///< the pilot's entry of the unit tangent

 private:
  const Mechanism& mechanism_;
  ClosureSystem system_;
  Newton newton_;
  FoldState<double> state_, trial_;
  DenseSolve factors_;
  SmallestSingularValue<double> smallest_;
  double open_by_ = 0, singular_value_ = 0, pilot_rate_ = 1;
  std::vector<double> rates_, misfit_, lengths_, slopes_;
};

}  // namespace misalign::solver
