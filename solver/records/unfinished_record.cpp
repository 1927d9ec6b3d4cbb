#include "solver/records/unfinished_record.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Lower bound of the singular value between two evaluated states, as a share of the smaller of
// theirs, unless it continues to fall beyond them; none lower was seen.
constexpr double kLeastBetween = 0.5;

// Largest difference from the function's lengths: functions' errors are far smaller, other branches
// farther away.
constexpr double kSameLength_widths = 1e-5;

// Returns whether a solved state is that of the function.
bool is_the_same(const PathRecord& record, const RequestedState& requested,
                 const SolvedState& solved) {
  if (!(solved.quality.open_by <= Newton::Options{}.closure_tolerance)) return false;
  if (requested.sample == 0) return true;
  const std::size_t diagonals = record.flat.size();
  const double* const expected =
      record.lengths.data() + static_cast<std::size_t>(requested.sample - 1) * diagonals;
  for (std::size_t d = 0; d < diagonals; ++d) {
    if (!(std::abs(solved.lengths[d] - expected[d]) <= kSameLength_widths)) return false;
  }
  return true;
}

// Returns whether the least of these singular values is the path's up to D.
bool ends_are_least(const std::vector<double>& values, int in_order) {
  if (in_order <= 4) return true;  // all were evaluated
  const std::size_t last = values.size() - 1;
  const double least = std::min(values[0], values[last]);
  const bool falls_to_first = values[0] <= values[1],
             falls_to_last = values[last] <= values[last - 1];
  for (std::size_t k = 1; k + 2 <= last; ++k) {
    const double value = values[k], next = values[k + 1];
    if (kLeastBetween * std::min(value, next) >= least) continue;
    const bool leads_to_first = k == 1 && falls_to_first && value <= next;
    const bool leads_to_last = k + 2 == last && falls_to_last && next <= value;
    if (!leads_to_first && !leads_to_last) return false;
  }
  return least <= values[1] && least <= values[last - 1];
}

}  // namespace

void complete(UnfinishedRecord& made, const std::vector<SolvedState>& solved,
              std::optional<double> miscut_margin_mm) {
  assert(made.is_sure && made.is_accepted);
  assert(std::ssize(solved) == made.requested.count());
  PathRecord& record = made.record;
  record.miscut_margin_mm = miscut_margin_mm;
  for (std::size_t k = 0; k < solved.size(); ++k) {
    made.is_sure =
        made.is_sure && is_the_same(record, made.requested[static_cast<int>(k)], solved[k]);
  }
  if (!made.is_sure) return;
  const auto solved_for = [&](Purpose purpose) -> const SolvedState& {
    return solved[static_cast<std::size_t>(made.requested.index_of(purpose))];
  };
  const auto put_lengths = [&](int sample, const SolvedState& state) {
    std::copy(state.lengths.begin(), state.lengths.end(),
              record.lengths.begin() + static_cast<std::ptrdiff_t>(sample - 1) *
                                           static_cast<std::ptrdiff_t>(state.lengths.size()));
  };
  const int in_order = record.verdict.deploys_from_sample;
  put_lengths(std::max(in_order - 1, 1), solved_for(Purpose::before_d));
  put_lengths(in_order, solved_for(Purpose::at_d));
  if (made.least_step_sample > 0) {
    put_lengths(std::max(made.least_step_sample - 1, 1), solved_for(Purpose::before_least_step));
    put_lengths(made.least_step_sample, solved_for(Purpose::after_least_step));
  }
  const auto judged = static_cast<std::size_t>(made.requested.index_of(Purpose::least_slope));
  for (std::size_t k = 0; k < judged; ++k) {
    record.residual_max = std::max(record.residual_max, solved[k].quality.open_by);
    record.isometry_error = std::max(record.isometry_error, solved[k].quality.isometry_error);
  }
  const auto singular_of = [&](Purpose purpose) {
    return solved_for(purpose).quality.singular_value_min;
  };
  std::vector<double> values = {singular_of(Purpose::first), singular_of(Purpose::second)};
  const std::vector<int>& margin_samples = made.requested.margin_samples();
  for (std::size_t k = 0; k < margin_samples.size(); ++k) {
    if (margin_samples[k] > 2 && margin_samples[k] < in_order - 1) {
      values.push_back(solved[k].quality.singular_value_min);
    }
  }
  for (const Purpose last : {Purpose::before_d, Purpose::at_d}) values.push_back(singular_of(last));
  record.singular_value_min = *std::min_element(values.begin(), values.end());
  made.is_sure = made.slopes.put_into(record, solved_for(Purpose::at_d).slopes,
                                      solved_for(Purpose::least_slope).slopes,
                                      solved_for(Purpose::reversal).slopes) &&
                 std::isfinite(record.singular_value_min) && ends_are_least(values, in_order);
}

void find_incomplete(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets) {
  sheets.clear();
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (records[k].is_sure && records[k].is_accepted) sheets.push_back(static_cast<int>(k));
  }
}

void find_unsure(const std::vector<UnfinishedRecord>& records, std::vector<int>& sheets) {
  sheets.clear();
  for (std::size_t k = 0; k < records.size(); ++k) {
    if (!records[k].is_sure) sheets.push_back(static_cast<int>(k));
  }
}

void merge(std::vector<UnfinishedRecord>& records, const std::vector<FoldingHistory>& histories,
           const Mechanism& mechanism, std::vector<PathRecord>& merged) {
  assert(records.size() == histories.size());
  merged.resize(records.size());
  for (std::size_t k = 0; k < records.size(); ++k) {
    merged[k] =
        records[k].is_sure ? std::move(records[k].record) : record_of(histories[k], mechanism);
  }
}

}  // namespace misalign::solver
