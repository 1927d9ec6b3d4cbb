#include "solver/verdict/between.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {

CubicBetween cubic_between(const CubicBetween::Sample& from, const CubicBetween::Sample& next,
                           double step_rad, double slowing, int direction) {
  assert(step_rad > 0 && slowing > 0);
  const double u = 2 * step_rad / (1 + slowing), v = u * (slowing - 1);
  const double rise = direction * (next.length - from.length);
  const double b = direction * from.slope * u, end = direction * next.slope * (u * slowing);
  return {u, v, b, 3 * rise - 2 * b - end, b + end - 2 * rise};
}

// Solves the quadratic in the form that does not cancel.
void CubicBetween::find_turns(double& first, double& second) const {
  first = 0;
  second = 1;
  const double square = c * c - 3 * d * b;
  if (!(square > 0)) return;
  const double q = -(c + std::copysign(std::sqrt(square), c));
  first = q == 0 ? 0 : std::clamp(b / q, 0.0, 1.0);
  second = d == 0 ? 1 : std::clamp(q / (3 * d), 0.0, 1.0);
  if (first > second) std::swap(first, second);
}

void Retreat::go_along(const CubicBetween& cubic) {
  double parts[4] = {0, 0, 1, 1};
  cubic.find_turns(parts[1], parts[2]);
  for (int k = 0; k < 3; ++k) go(cubic.length(parts[k + 1]) - cubic.length(parts[k]));
}

BetweenSamples look_between(const CubicBetween::Sample& from, const CubicBetween::Sample& next,
                            double step_rad, double slowing, int direction) {
  const CubicBetween cubic = cubic_between(from, next, step_rad, slowing, direction);
  const auto& [u, v, b, c, d] = cubic;
  double least = std::min(direction * from.slope, direction * next.slope);
  // The slope is stationary where 3 d v t^2 + 6 d u t + 2 c u - b v = 0. This is the root at which
  // the pilot increases, u + v t > 0.
  const double half = 3 * d * u, product = 3 * d * v * (2 * c * u - b * v);
  if (const double square = half * half - product; d != 0 && square >= 0) {
    const double t = -(2 * c * u - b * v) / (half + std::copysign(std::sqrt(square), half));
    if (t > 0 && t < 1) least = std::min(least, cubic.rate(t) / (u + v * t));
  }
  BetweenSamples between{least, 0, 0};
  if (!(least < 0)) return between;
  // The slope is negative between its zeros only.
  double parts[4] = {0, 0, 1, 1};
  cubic.find_turns(parts[1], parts[2]);
  for (int k = 0; k < 3; ++k) {
    const double back = cubic.length(parts[k]) - cubic.length(parts[k + 1]);
    if (back <= 0) continue;
    if (between.back == 0) between.from = parts[k] * (u + v * parts[k] / 2) / step_rad;
    between.back = std::max(between.back, back);
  }
  return between;
}

}  // namespace misalign::solver
