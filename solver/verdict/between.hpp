// Interpolates a diagonal between two samples by the cubic along the path through both lengths and
// both rates of change (Hermite), which shows bumps that lengths at samples do not. It also counts
// how far a diagonal has gone back.
#pragma once

#include <algorithm>

namespace misalign::solver {

/// A retreat between two samples counts if it is longer than this (8e-9 mm on 80 mm panels):
/// converged rates of change leave 1e-11 in the cubic.
inline constexpr double kBumpBand_widths = 1e-10;

/// Rule by which a diagonal that goes back between two samples ends the deployable range.
enum class BumpRule {
  ignored,   ///< never: the samples alone are judged
  by_cubic,  ///< if the cubic through both samples goes back by kBumpBand_widths or more
  exact  ///< if the diagonal itself goes back by that or more between two samples (flat counts as
         ///< one)
};

struct CubicBetween;

/// Retreat of a quantity that alternates in direction: the largest decrease from any point to a
/// later one.
struct Retreat {
  double now = 0;      ///< distance behind the farthest point so far
  double longest = 0;  ///< largest `now` so far

  void go(double on) {
    now = std::max(0.0, now - on);
    longest = std::max(longest, now);
  }
  void go_along(const CubicBetween& cubic);
};

/// Behaviour of the cubic between two samples.
struct BetweenSamples {
  double least_slope;  ///< least rate of change along `direction`, panel widths per radian
  double back;         ///< largest retreat against `direction`, panel widths, or 0
  double from;         ///< beginning of the first retreat, 0 to 1 of the pilot's step
};

/// The cubic b t + c t^2 + d t^3, with t from 0 to 1 along the path: the length less that at this
/// sample, increasing in the diagonal's direction. The pilot's rate is u + v t.
struct CubicBetween {
  struct Sample {
    double length;  ///< panel widths
    double slope;   ///< panel widths per radian of pilot
  };

  double u, v, b, c, d;

  double length(double t) const { return ((d * t + c) * t + b) * t; }
  double rate(double t) const { return (3 * d * t + 2 * c) * t + b; }
  /// Change of the pilot's angle from this sample.
  double pilot(double t) const { return t * (u + v * t / 2); }
  /// Finds its turning points, 0 <= first <= second <= 1; those that are missing lie at an end.
  void find_turns(double& first, double& second) const;
};
/// Makes the cubic from the arguments of look_between.
CubicBetween cubic_between(const CubicBetween::Sample& from, const CubicBetween::Sample& next,
                           double step_rad, double slowing, int direction);

/// Examines two samples `step_rad` apart; `direction` is +1 for a diagonal that grows, -1 for one
/// that shrinks. `slowing` (positive) is the pilot's rate along the path at the next sample, to
/// that at this one: 1 far from a fold limit, near 0 just before one. Rates of change grow without
/// bound there, and a cubic in the pilot itself would show false bumps; along the path all is
/// smooth, the pilot a parabola. Without slowing the cubic's error is step^4 / 384 times the fourth
/// derivative of the length.
BetweenSamples look_between(const CubicBetween::Sample& from, const CubicBetween::Sample& next,
                            double step_rad, double slowing, int direction);

/// Rate of change at flat of a spring that ends off the mid-plane, by the parabola through its
/// change up to the first sample (panel widths) and its rate there.
inline double slope_at_flat(double on, double slope, double pilot_rad) {
  return 2 * on / pilot_rad - slope;
}

}  // namespace misalign::solver
