#include "solver/fitting/stock_spring.hpp"

#include <cmath>

namespace misalign::solver {
namespace {

// A length that is a whole number of steps but for rounding is that number.
constexpr double kRounding = 1e-9;
constexpr double kMostSteps = 1e8;

}  // namespace

LinkRange links_of(const StockSpring& spring, double least_mm, double most_mm,
                   const LinkLimits& limits) {
  const bool pulls = spring.action == SpringAction::pulls;
  double low_mm = most_mm - (pulls ? spring.limit_mm : spring.free_mm);
  double high_mm = least_mm - (pulls ? spring.free_mm : spring.limit_mm);
  if (limits.largest_force_n) {
    const double give_mm = (*limits.largest_force_n - spring.initial_n) / spring.rate_n_per_mm;
    if (give_mm < 0) return {0, -1};
    if (pulls) low_mm = std::max(low_mm, most_mm - spring.free_mm - give_mm);
    if (!pulls) high_mm = std::min(high_mm, least_mm - spring.free_mm + give_mm);
  }
  low_mm = std::max(low_mm, limits.least_mm);
  const auto steps = [&](double mm) {
    return std::clamp(mm / limits.step_mm, -kMostSteps, kMostSteps);
  };
  return {static_cast<int>(std::ceil(steps(low_mm) - kRounding)),
          static_cast<int>(std::floor(steps(high_mm) + kRounding))};
}

}  // namespace misalign::solver
