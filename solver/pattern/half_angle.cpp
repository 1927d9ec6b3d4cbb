#include "solver/pattern/half_angle.hpp"

#include <cassert>

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

HalfAngle<double> half_angle_of_ratio(double numerator, double denominator) {
  assert(numerator != 0 || denominator != 0);
  const double scale = 1.0 / std::sqrt(numerator * numerator + denominator * denominator);
  return {denominator * scale, numerator * scale};
}

}  // namespace misalign::solver
