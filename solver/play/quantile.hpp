// Quantiles of studies that try many copies of a sheet.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace misalign::solver {

/// Quantiles that studies show.
inline constexpr double kShownShares[] = {0, 0.05, 0.25, 0.5, 0.75, 0.95, 1};

/// Quantile of values in ascending order, of which there is at least one: 0.5 is the median.
inline double quantile(const std::vector<double>& values, double share) {
  assert(!values.empty() && share >= 0 && share <= 1);
  const auto count = std::max(1.0, std::ceil(share * static_cast<double>(values.size())));
  return values[static_cast<std::size_t>(count) - 1];
}

}  // namespace misalign::solver
