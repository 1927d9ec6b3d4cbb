#include "schema/campaign/split_rate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::schema {
namespace {

// Computes a cube root by Newton's method from above, until it no longer falls.
double cube_root(double value) {
  if (value < 0) return -cube_root(-value);
  if (value == 0) return 0;
  double root = std::max(1.0, value);
  while (true) {
    const double next = root - (root - value / (root * root)) / 3;
    if (!(next < root)) return root;
    root = next;
  }
}

// Returns the 97.5 % quantile of Student's t distribution, expanded about the normal z (Fisher and
// Cornish, Technometrics 2, 1960); accurate to 2e-5 from 19 degrees of freedom on.
double student_quantile(double freedom) {
  constexpr double z = 1.959963984540054, z2 = z * z;
  constexpr double first = z * (z2 + 1) / 4, second = z * ((5 * z2 + 16) * z2 + 3) / 96,
                   third = z * (((3 * z2 + 19) * z2 + 17) * z2 - 15) / 384;
  return z + (first + (second + third / freedom) / freedom) / freedom;
}

// Returns the T whose transform is `quantile`, with k = g / (3 sqrt(n)): the transform less k / 2
// is ((1 + k T)^3 - 1) / (3 k). Written without cancellation for small k.
double untransformed(double quantile, double k) {
  const double w = quantile - k / 2;
  const double root = cube_root(1 + 3 * k * w);
  return 3 * w / ((root + 1) * root + 1);
}

// Returns the interval of shares over their mean.
ShareInterval hall_interval(const std::vector<double>& relative) {
  assert(relative.size() > 1);
  const auto n = static_cast<double>(relative.size());
  double squares = 0, cubes = 0;
  for (const double value : relative) {
    const double off = value - 1;
    squares += off * off;
    cubes += off * off * off;
  }
  const double variance = squares / n;
  if (!(variance > 0)) return {1, 1};
  const double skewness = cubes / n / (variance * std::sqrt(variance));
  const double k = skewness / (3 * std::sqrt(n)), error = std::sqrt(variance / (n - 1));
  const double quantile = student_quantile(n - 1);
  return {1 - untransformed(quantile, k) * error, 1 - untransformed(-quantile, k) * error};
}

}  // namespace

std::optional<double> SplitRate::relative_half_width() const {
  if (!interval) return std::nullopt;
  return (interval->high - interval->low) / 2 / mean;
}

SplitRate split_rate(const std::vector<double>& shares) {
  SplitRate rate;
  rate.populations = shares.size();
  std::vector<double> sorted = shares;
  std::ranges::sort(sorted);
  double sum = 0;
  for (const double share : sorted) {
    sum += share;
    rate.reached += share > 0;
  }
  if (rate.reached == 0) return rate;
  rate.mean = sum / static_cast<double>(sorted.size());
  rate.largest_part = sorted.back() / sum;
  if (rate.populations < kLeastPopulations) return rate;
  for (double& share : sorted) share /= rate.mean;
  const ShareInterval relative = hall_interval(sorted);
  rate.interval = {std::max(relative.low * rate.mean, 0.0),
                   std::min(relative.high * rate.mean, 1.0)};
  return rate;
}

bool has_converged(const SplitRate& rate) {
  return rate.interval && rate.largest_part <= kLargestPart && rate.reached >= kLeastReached;
}

std::string why_not_converged(const SplitRate& rate) {
  if (rate.populations < kLeastPopulations) {
    return fmt::format("an interval is shown from {} populations on", kLeastPopulations);
  }
  if (has_converged(rate)) return "";
  if (rate.reached < kLeastReached) {
    return fmt::format(
        "the rate is not reliable yet: {} of {} populations reached the last level, and at least "
        "{} must; more populations help, or more particles and sweeps",
        rate.reached, rate.populations, kLeastReached);
  }
  return fmt::format(
      "the rate is not reliable yet: one population makes up {:.0f} % of it; more "
      "populations help, or more particles and sweeps",
      100 * rate.largest_part);
}

}  // namespace misalign::schema
