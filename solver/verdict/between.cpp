#include "solver/verdict/between.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::solver {

BetweenSamples look_between(const LengthAndSlope& here, const LengthAndSlope& next, double step_rad,
                            double slowing, int direction) {
  // With t from 0 to 1 along the path the pilot's rate is u + v t, and the length is
  // p(t) = b t + c t^2 + d t^3, growing where the diagonal goes on.
  const double u = 2 * step_rad / (1 + slowing), v = u * (slowing - 1);
  const double rise = direction * (next.length - here.length);
  const double b = direction * here.slope * u, end = direction * next.slope * (u * slowing);
  const double c = 3 * rise - 2 * b - end, d = b + end - 2 * rise;
  const auto length = [&](double t) { return ((d * t + c) * t + b) * t; };
  const auto slope = [&](double t) { return ((3 * d * t + 2 * c) * t + b) / (u + v * t); };
  double least = std::min(direction * here.slope, direction * next.slope);
  // The slope is stationary where 3 d v t^2 + 6 d u t + 2 c u - b v = 0. Of the two roots this is
  // the one where the pilot goes on, u + v t > 0.
  const double half = 3 * d * u, product = 3 * d * v * (2 * c * u - b * v);
  if (const double square = half * half - product; d != 0 && square >= 0) {
    const double t = -(2 * c * u - b * v) / (half + std::copysign(std::sqrt(square), half));
    if (t > 0 && t < 1) least = std::min(least, slope(t));
  }
  BetweenSamples between{least, 0, 0};
  if (!(least < 0)) return between;
  // Where the slope is negative: between its zeros, in the form that does not cancel.
  double zeros[2] = {0, 1};
  if (const double square = c * c - 3 * d * b; square > 0) {
    const double q = -(c + std::copysign(std::sqrt(square), c));
    zeros[0] = q == 0 ? 0 : std::clamp(b / q, 0.0, 1.0);
    zeros[1] = d == 0 ? 1 : std::clamp(q / (3 * d), 0.0, 1.0);
    if (zeros[0] > zeros[1]) std::swap(zeros[0], zeros[1]);
  }
  const double parts[4] = {0, zeros[0], zeros[1], 1};
  for (int k = 0; k < 3; ++k) {
    const double back = length(parts[k]) - length(parts[k + 1]);
    if (back <= 0) continue;
    if (between.back == 0) between.from = parts[k] * (u + v * parts[k] / 2) / step_rad;
    between.back = std::max(between.back, back);
  }
  return between;
}

}  // namespace misalign::solver
