#include "solver/optimise/low_slopes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// An eighth of the distance between stations, from which polynomials show every bend.
constexpr int kSlopesPerStation = 8;
// Slopes are undefined where the pilot's rate or sine is smaller than this.
constexpr double kStandsStill = 1e-4;

}  // namespace

std::vector<LowSlope> low_slopes(const Sheet& sheet, double to_deg) {
  assert(sheet.way() && to_deg > 0);
  const FoldingWay& way = *sheet.way();
  const double to_x = way.x_of(std::min(to_deg, way.end_deg()));
  const int count = kSlopesPerStation * static_cast<int>(way.stations().size());
  VectorXd lengths_mm, rates_mm;
  way.find_lengths(to_x, lengths_mm, rates_mm);
  const VectorXd side = (lengths_mm - way.flat_mm()).cwiseSign();
  std::vector<double> angles_deg;
  std::vector<VectorXd> slopes;
  for (int k = 1; k <= count; ++k) {
    const double x = to_x * k / count, sine = std::sin(way.pilot_deg(x) * kRadPerDeg);
    if (way.pilot_rate(x) < kStandsStill || sine < kStandsStill) continue;
    way.find_lengths(x, lengths_mm, rates_mm);
    angles_deg.push_back(way.pilot_deg(x));
    slopes.push_back(kRadPerDeg / (way.pilot_rate(x) * sine) * side.cwiseProduct(rates_mm));
  }
  std::vector<LowSlope> lows;
  assert(angles_deg.size() == slopes.size());
  for (Index d = 0; d < side.size(); ++d) {
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      const double slope = slopes[k](d);
      if (k > 0 && slopes[k - 1](d) < slope) continue;
      if (k + 1 < slopes.size() && slopes[k + 1](d) <= slope) continue;
      lows.push_back({d, angles_deg[k], slope});
    }
  }
  return lows;
}

double least_slope_mm_per_deg(const Sheet& sheet, double to_deg) {
  double least = std::numeric_limits<double>::infinity();
  for (const LowSlope& low : low_slopes(sheet, to_deg)) least = std::min(least, low.mm_per_deg);
  return least;
}

}  // namespace misalign::solver
