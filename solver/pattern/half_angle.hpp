// Keeps a fold angle as the cosine and sine of its half: the unit quaternion of a rotation about a
// known axis. It has no branch cut on (-360, 360) degrees, |rho| > 180 shows as c < 0, and turning
// it by a Newton step needs no sine or cosine of the C library, whose last bits differ by
// processor.
#pragma once

#include <cmath>

namespace misalign::solver {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadPerDeg = kPi / 180.0;

template <class T>
struct HalfAngle {
  T c, s;  ///< cos(rho / 2) and sin(rho / 2)

  /// This angle turned by `delta` (rad, to second order), back on the unit circle: the retraction
  /// (c, s) <- (c - s delta/2, s + c delta/2) / sqrt(1 + delta^2/4).
  HalfAngle turned(const T& delta) const {
    using std::sqrt;
    const T h = T(0.5) * delta;
    const T cn = c - s * h, sn = s + c * h;
    const T scale = T(1) / sqrt(cn * cn + sn * sn);
    return {cn * scale, sn * scale};
  }
};

/// sin(half of (a - b)): positive when a is the larger angle; exact in sign near equality.
template <class T>
T half_sine_between(const HalfAngle<T>& a, const HalfAngle<T>& b) {
  return a.s * b.c - a.c * b.s;
}

/// Half angle of `angle_deg` in [-360, 360], by Taylor series of fixed order: the same bits
/// everywhere, within 2 ulp (tested against the C library).
HalfAngle<double> half_angle_of_deg(double angle_deg);
/// The same of an angle in radians, in [-2 pi, 2 pi].
HalfAngle<double> half_angle_of_rad(double angle_rad);

/// The angle in (-2 pi, 2 pi], by a series too: the same bits everywhere, within 4 ulp.
double angle_rad(const HalfAngle<double>& h);
/// Angles of `count` halves (rad), the same bits as one by one.
void find_angles(const HalfAngle<double>* halves, int count, double* angles_rad);

/// Half angle from tan(rho / 2) = numerator / denominator; the denominator may be zero.
HalfAngle<double> half_angle_of_ratio(double numerator, double denominator);

/// The angle in degrees, in (-360, 360].
inline double angle_deg(const HalfAngle<double>& h) { return angle_rad(h) / kRadPerDeg; }

}  // namespace misalign::solver
