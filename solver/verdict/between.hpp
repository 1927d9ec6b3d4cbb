// A diagonal between two samples of its path: the cubic along the path through both lengths and
// both rates of change (Hermite). It sees a bump that the lengths at the samples alone do not.
// How far a diagonal has gone back is counted here too.
#pragma once

#include <algorithm>

namespace misalign::solver {

/// A way back between two samples counts when it is longer than this (8e-9 mm on 80 mm panels):
/// converged rates of change leave 1e-11 in the cubic.
inline constexpr double kBumpBand_widths = 1e-10;

/// When a diagonal that goes back between two samples ends the deployable range.
enum class BumpRule {
  ignored,   ///< never: the samples alone are judged
  by_cubic,  ///< where the cubic through both samples goes back by kBumpBand_widths or more
  exact      ///< where the path does: on the way from one sample to the next (flat counts as one)
             ///< the diagonal falls short of how far it had come by that much or more
};

struct CubicBetween;

/// How far back a quantity goes that moves on and back by turns: the longest way from any point to
/// a later one.
struct Retreat {
  double now = 0;      ///< how far it is behind the farthest point so far
  double longest = 0;  ///< the most it was

  void go(double on) {
    now = std::max(0.0, now - on);
    longest = std::max(longest, now);
  }
  void go_along(const CubicBetween& cubic);
};

/// What the cubic does on the way from one sample to the next.
struct BetweenSamples {
  double least_slope;  ///< least rate of change along `direction`, panel widths per radian
  double back;         ///< how far it goes against it, panel widths; 0: nowhere
  double from;         ///< where that begins, 0 to 1 of the pilot's step
};

/// The cubic itself, with t from 0 to 1 along the path. The length counts from this sample, growing
/// where the diagonal goes on: b t + c t^2 + d t^3; the pilot's rate is u + v t.
struct CubicBetween {
  struct Sample {
    double length;  ///< panel widths
    double slope;   ///< panel widths per radian of pilot
  };

  double u, v, b, c, d;

  double length(double t) const { return ((d * t + c) * t + b) * t; }
  double rate(double t) const { return (3 * d * t + 2 * c) * t + b; }
  /// The pilot's way from this sample.
  double pilot(double t) const { return t * (u + v * t / 2); }
  /// Where it turns, 0 <= first <= second <= 1; at an end where it does not.
  void find_turns(double& first, double& second) const;
};
/// Its arguments are those of look_between.
CubicBetween cubic_between(const CubicBetween::Sample& here, const CubicBetween::Sample& next,
                           double step_rad, double slowing, int direction);

/// `step_rad` apart; `direction` is +1 for a diagonal that grows, -1 for one that shrinks.
/// `slowing` (positive) is the pilot's rate along the path at the next sample, to that at this one:
/// 1 far from a fold limit, near 0 just before one. There rates of change grow without bound, and a
/// cubic in the pilot itself would see bumps that are none; along the path all is smooth, the pilot
/// a parabola. Error of the cubic where nothing slows: step^4 / 384 times the fourth derivative of
/// the length.
BetweenSamples look_between(const CubicBetween::Sample& here, const CubicBetween::Sample& next,
                            double step_rad, double slowing, int direction);

/// Of springs that end off the mid-plane: their rate of change at flat, by the parabola through
/// what they moved by up to a first sample (panel widths) and their rate there.
inline double slope_at_flat(double on, double slope, double pilot_rad) {
  return 2 * on / pilot_rad - slope;
}

}  // namespace misalign::solver
