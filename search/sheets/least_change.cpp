#include "search/sheets/least_change.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::search {
namespace {

constexpr int kMostFactors = 4, kBisections = 3;
// Units of the second digit that are rounding.
constexpr double kSameDigit = 1e-9;

}  // namespace

std::optional<double> least_change(double start, double score, const ChangeLimits& limits,
                                   const Judge& judge) {
  double bad = start, best = score;
  for (int k = 1; k <= kMostFactors; ++k) {
    double good = std::clamp(start * std::pow(limits.factor, k), limits.least, limits.most);
    if (good == bad) break;
    const Judged judged = judge(good);
    if (judged.passes) {
      for (int step = 0; step < kBisections; ++step) {
        const double middle = std::sqrt(bad * good);
        (judge(middle).passes ? good : bad) = middle;
      }
      return good;
    }
    if (judged.score <= best) break;
    best = judged.score;
    bad = good;
  }
  return {};
}

double two_digits(double value, Rounding rounding) {
  if (!(value > 0)) return value;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1), digits = value / unit;
  switch (rounding) {
    case Rounding::up:
      return std::ceil(digits - kSameDigit) * unit;
    case Rounding::down:
      return std::floor(digits + kSameDigit) * unit;
    case Rounding::nearest:
      break;
  }
  return std::round(digits) * unit;
}

}  // namespace misalign::search
