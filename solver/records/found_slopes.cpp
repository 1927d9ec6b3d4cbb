#include "solver/records/found_slopes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Errors of rates of change, panel widths per radian: of the function's least rate, and of solved
// rates.
constexpr double kSameSlope = 1e-6, kSlopeError = 1e-9;

// Least slope in the diagonals' directions, which follow from the lengths at D.
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
  reversal_ = ReversalSecants(finder.first_reversal());
}

std::optional<double> FoundSlopes::next_reversal_deg(const std::vector<double>& slopes) {
  if (!has_reversal() || sets_out_back() || reversal_.is_sure()) return std::nullopt;
  return reversal_.next_deg(slopes);
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
  record.extremes.reverses_deg = reversal_.reversal().pilot_deg;
  if (sets_out_back()) return true;
  const double off = kSlopeError + reversal_.slope_error();
  const bool is_first =
      least_of(at_reversal, record) >= -off;  // no other diagonal has reversed before
  return reversal_.is_sure() && is_first;
}

}  // namespace misalign::solver
