// The direction in which a diagonal sets out from flat, by its length and its rate of change at a
// first small angle.
#pragma once

#include "solver/verdict/verdict.hpp"

namespace misalign::solver {

/// There lengths are even in the pilot's angle, a rho^2 + b rho^4: by how much each part of them
/// has moved it in its direction, panel widths.
struct FromFlat {
  double square, fourth;

  FromFlat(double on, double slope, double pilot_rad)
      : square(2 * on - slope * pilot_rad / 2), fourth(slope * pilot_rad / 2 - on) {}
  /// By more than rates of change are known to.
  bool sets_out_back() const { return square < -kBumpBand_widths; }
};

}  // namespace misalign::solver
