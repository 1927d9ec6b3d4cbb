#include "solver/records/found_slopes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// A reversal is moved by the step that the exact slope asks for, if that is no longer than this,
// and solved again until it is shorter than that: curvatures are known to a tenth.
constexpr double kLongestReversalStep_rad = 1e-3, kSureReversalStep_rad = 3e-8;

// Rates of change, panel widths per radian: what the function's may be off by where it is least,
// and what solved ones are worth.
constexpr double kSameSlope = 1e-6, kSlopeError = 1e-9;

// In the diagonals' directions, which the lengths at D say.
double least_of(const std::vector<double>& slopes, const PathRecord& record) {
  const std::size_t count = slopes.size();
  assert(count == record.flat.size() && record.lengths.size() >= count);
  const double* const at_d = record.lengths.data() + record.lengths.size() - count;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t d = 0; d < count; ++d) {
    const double moved = at_d[d] - record.flat[d];
    if (std::abs(moved) < kStepBand_widths) continue;
    least = std::min(least, moved > 0 ? slopes[d] : -slopes[d]);
  }
  return least;
}

}  // namespace

void FoundSlopes::begin(const ExtremeFinder& finder) {
  least_ = finder.least_slope();
  reversal_ = finder.first_reversal();
  step_rad_ = 0;
  reversal_is_sure_ = reversal_.pilot_deg == 0;
}

// Secants, after the first step by the function's curvature.
std::optional<double> FoundSlopes::next_reversal_deg(const std::vector<double>& slopes) {
  if (!has_reversal() || reversal_is_sure_) return std::nullopt;
  const double slope = slopes[static_cast<std::size_t>(reversal_.diagonal)];
  if (step_rad_ != 0) reversal_.curvature = (slope - slope_) / step_rad_;
  const double step_rad = -slope / reversal_.curvature;
  if (!(std::abs(step_rad) <= kLongestReversalStep_rad)) return std::nullopt;
  reversal_.pilot_deg += step_rad / kRadPerDeg;
  step_rad_ = step_rad;
  slope_ = slope;
  reversal_is_sure_ = std::abs(step_rad) <= kSureReversalStep_rad;
  if (reversal_is_sure_) return std::nullopt;
  return reversal_.pilot_deg;
}

bool FoundSlopes::put_into(PathRecord& record, const std::vector<double>& at_d,
                           const std::vector<double>& at_least,
                           const std::vector<double>& at_reversal) const {
  record.extremes.least_slope = least_.slope;
  if (std::isfinite(least_.slope)) {
    const double least = least_of(at_least, record);
    if (!(std::abs(least - least_.slope) <= kSameSlope)) return false;
    record.extremes.least_slope = std::min(least, least_of(at_d, record));
  }
  if (!has_reversal()) return true;
  record.extremes.reverses_deg = reversal_.pilot_deg;
  if (reversal_.pilot_deg == 0) return true;
  const double off = kSlopeError + std::abs(reversal_.curvature) * kSureReversalStep_rad;
  const bool is_first = least_of(at_reversal, record) >= -off;  // no other one has turned before
  return reversal_is_sure_ && is_first;
}

}  // namespace misalign::solver
