// A diagonal between two samples of its path: the cubic along the path through both lengths and
// both rates of change (Hermite). It sees a bump that the lengths at the samples alone do not.
#pragma once

#include <optional>

namespace misalign::solver {

/// A way back between two samples counts when it is longer than this (8e-9 mm on 80 mm panels):
/// converged rates of change leave 1e-11 in the cubic.
inline constexpr double kBumpBand_widths = 1e-10;

struct LengthAndSlope {
  double length;  ///< panel widths
  double slope;   ///< panel widths per radian of pilot
};

/// What the cubic does on the way from one sample to the next.
struct BetweenSamples {
  double least_slope;  ///< least rate of change along `direction`, panel widths per radian
  double back;         ///< how far it goes against it, panel widths; 0: nowhere
  double from;         ///< where that begins, 0 to 1 of the pilot's step
};

/// `step_rad` apart; `direction` is +1 for a diagonal that grows, -1 for one that shrinks.
/// `slowing` (positive) is the pilot's rate along the path at the next sample, to that at this one:
/// 1 far from a fold limit, near 0 just before one. There rates of change grow without bound, and a
/// cubic in the pilot itself would see bumps that are none; along the path all is smooth, the pilot
/// a parabola. Error of the cubic where nothing slows: step^4 / 384 times the fourth derivative of
/// the length.
BetweenSamples look_between(const LengthAndSlope& here, const LengthAndSlope& next, double step_rad,
                            double slowing, int direction);

}  // namespace misalign::solver
