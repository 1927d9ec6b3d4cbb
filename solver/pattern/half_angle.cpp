#include "solver/pattern/half_angle.hpp"

#include <algorithm>
#include <cassert>

// A function compiled once more for wide registers; the machine at hand decides which copy runs.
#if defined(MISALIGN_X86) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define MISALIGN_CLONES [[gnu::target_clones("avx512f", "avx2", "default")]]
#else
#define MISALIGN_CLONES
#endif

namespace misalign::solver {
namespace {

// Taylor polynomials, |x| <= pi/4: the first omitted term is below 1e-18.
double taylor_sine(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 17; k >= 1; k -= 2) sum = 1 - x2 / ((k + 1) * (k + 2)) * sum;
  return x * sum;
}

double taylor_cosine(double x) {
  const double x2 = x * x;
  double sum = 0;
  for (int k = 18; k >= 0; k -= 2) sum = 1 - x2 / ((k + 1) * (k + 2)) * sum;
  return sum;
}

// The arc tangent on [0, tan(pi / 8)]: the first omitted term is below 1e-18.
inline double taylor_arctangent(double x) {
  const double x2 = x * x, x4 = x2 * x2;
  double even = 0, odd = 0;  // side by side
#pragma GCC unroll 11
  for (int k = 41; k >= 1; k -= 4) {
    even = 1.0 / k + x4 * even;
    odd = 1.0 / (k + 2) + x4 * odd;
  }
  return x * (even - x2 * odd);
}

// This has no branches: several angles fit into a register.
[[gnu::always_inline]] inline double angle_of(double cosine, double sine) {
  constexpr double kEighth = 0.41421356237309503;  // tan(pi / 8)
  const double c = std::abs(cosine), s = std::abs(sine);
  const double large = std::max(c, s), small = std::min(c, s);
  const bool is_small = small <= kEighth * large;
  const double arc =
      taylor_arctangent((is_small ? small : large - small) / (is_small ? large : large + small));
  const double first = is_small ? arc : kPi / 4 - arc;
  const double second = s > c ? kPi / 2 - first : first;
  const double half = cosine < 0 ? kPi - second : second;
  return sine < 0 ? -2 * half : 2 * half;
}

// The right angle less kPi / 2.
constexpr double kRestOfRightAngle = 6.123233995736766e-17;

}  // namespace

HalfAngle<double> half_angle_of_deg(double angle_deg) {
  if (angle_deg < 0) {
    const HalfAngle<double> mirrored = half_angle_of_deg(-angle_deg);
    return {mirrored.c, -mirrored.s};
  }
  const double half_deg = 0.5 * angle_deg;  // 0 to 180
  if (half_deg <= 45) {
    return {taylor_cosine(half_deg * kRadPerDeg), taylor_sine(half_deg * kRadPerDeg)};
  }
  if (half_deg <= 135) {
    const double beyond = (half_deg - 90) * kRadPerDeg;
    return {-taylor_sine(beyond), taylor_cosine(beyond)};
  }
  const double short_of = (180 - half_deg) * kRadPerDeg;
  return {-taylor_cosine(short_of), taylor_sine(short_of)};
}

HalfAngle<double> half_angle_of_rad(double angle_rad) {
  const double half = 0.5 * std::abs(angle_rad), side = angle_rad < 0 ? -1 : 1;
  assert(half <= kPi + 1e-12);
  if (half <= kPi / 4) return {taylor_cosine(half), side * taylor_sine(half)};
  if (half <= 3 * kPi / 4) {
    const double beyond = (half - kPi / 2) - kRestOfRightAngle;
    return {-taylor_sine(beyond), side * taylor_cosine(beyond)};
  }
  const double short_of = (kPi - half) + 2 * kRestOfRightAngle;
  return {-taylor_cosine(short_of), side * taylor_sine(short_of)};
}

double angle_rad(const HalfAngle<double>& h) {
  assert(h.c != 0 || h.s != 0);
  return angle_of(h.c, h.s);
}

MISALIGN_CLONES void find_angles(const HalfAngle<double>* halves, int count, double* angles_rad) {
  for (int k = 0; k < count; ++k) angles_rad[k] = angle_of(halves[k].c, halves[k].s);
}

HalfAngle<double> half_angle_of_ratio(double numerator, double denominator) {
  assert(numerator != 0 || denominator != 0);
  const double scale = 1.0 / std::sqrt(numerator * numerator + denominator * denominator);
  return {denominator * scale, numerator * scale};
}

}  // namespace misalign::solver
