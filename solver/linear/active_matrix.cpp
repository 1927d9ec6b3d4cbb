#include "solver/linear/active_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace misalign::solver {
namespace {

// A pivot replaces an equally cheap one if its share is larger by this factor. On the symmetric
// base many shares differ only by rounding, which must not choose. Factors above 1 also cost fewer
// operations (6 x 6: 1,712 instead of 1,809).
constexpr double kMarkedlyLarger = 4;

// Smallest share over all states. A pivot that changes its sign between two states is zero
// somewhere between them: its share counts a millionth.
double least_share(const PivotValues& values, const PivotValues& largest) {
  double share = 1;
  for (int s = 0; s < kPivotStates; ++s) {
    const double ratio = largest[s] > 0 ? std::abs(values[s]) / largest[s] : 0;
    share = std::min(share, values[s] * values[0] > 0 ? ratio : 1e-6 * ratio);
  }
  return share;
}

}  // namespace

const PivotValues& ActiveMatrix::Row::at(int column) const {
  const auto place = std::lower_bound(columns.begin(), columns.end(), column);
  assert(place != columns.end() && *place == column);
  return values[static_cast<std::size_t>(place - columns.begin())];
}

bool ActiveMatrix::Candidate::before(const Candidate& other) const {
  return cost < other.cost || (cost == other.cost && share > kMarkedlyLarger * other.share);
}

ActiveMatrix::ActiveMatrix(const std::vector<JacobianEntry>& entries,
                           const std::vector<PivotValues>& values, int equations)
    : rows_(equations), rows_in_(equations + 1), candidates_(equations + 1) {
  assert(entries.size() == values.size());
  std::vector<std::vector<std::pair<int, std::size_t>>> in_row(equations);
  for (std::size_t e = 0; e < entries.size(); ++e) {
    in_row[entries[e].row].push_back({entries[e].column, e});
  }
  for (int row = 0; row < equations; ++row) {
    std::sort(in_row[row].begin(), in_row[row].end());
    for (const auto& [column, entry] : in_row[row]) {
      rows_[row].columns.push_back(column);
      rows_[row].values.push_back(values[entry]);
      rows_in_[column].push_back(row);
    }
  }
}

ActiveMatrix::~ActiveMatrix() = default;

ActiveMatrix::Place ActiveMatrix::choose(const std::vector<int>& columns, double threshold) {
  if (threshold != threshold_) candidates_.assign(candidates_.size(), {});
  threshold_ = threshold;
  Place best;
  Candidate least;
  for (const int column : columns) {
    Candidate& candidate = candidates_[column];
    if (!candidate.known) candidate = best_in(column);
    if (candidate.row >= 0 && candidate.before(least)) {
      least = candidate;
      best = {candidate.row, column};
    }
  }
  return best;
}

void ActiveMatrix::eliminate(const Place& pivot) {
  assert(pivot.row >= 0 && !rows_[pivot.row].columns.empty());  // eliminated once
  const Row pivot_row = std::move(rows_[pivot.row]);
  for (const int column : pivot_row.columns) {
    auto& rows = rows_in_[column];
    assert(std::binary_search(rows.begin(), rows.end(), pivot.row));
    rows.erase(std::lower_bound(rows.begin(), rows.end(), pivot.row));
    candidates_[column].known = false;
  }
  const PivotValues& pivot_values = pivot_row.at(pivot.column);
  for (const int row : rows_in_[pivot.column]) {
    PivotValues factors = rows_[row].at(pivot.column);
    for (int s = 0; s < kPivotStates; ++s) factors[s] = factors[s] / pivot_values[s];
    subtract(factors, pivot_row, pivot.column, row);
    for (const int column : rows_[row].columns) candidates_[column].known = false;
  }
  rows_in_[pivot.column].clear();
}

// Merges `factors` times the pivot's row into another, which loses the pivot's column.
void ActiveMatrix::subtract(const PivotValues& factors, const Row& pivot_row, int pivot_column,
                            int row) {
  Row& old = rows_[row];
  merged_.columns.clear();
  merged_.values.clear();
  std::size_t next = 0;
  const auto keep_up_to = [&](int column) {
    for (; next < old.columns.size() && old.columns[next] < column; ++next) {
      merged_.columns.push_back(old.columns[next]);
      merged_.values.push_back(old.values[next]);
    }
  };
  for (std::size_t k = 0; k < pivot_row.columns.size(); ++k) {
    const int column = pivot_row.columns[k];
    keep_up_to(column);
    const bool is_there = next < old.columns.size() && old.columns[next] == column;
    next += is_there;
    if (column == pivot_column) continue;
    merged_.columns.push_back(column);
    PivotValues& target =
        merged_.values.emplace_back(is_there ? old.values[next - 1] : PivotValues{});
    for (int s = 0; s < kPivotStates; ++s) target[s] -= factors[s] * pivot_row.values[k][s];
    if (is_there) continue;
    auto& rows = rows_in_[column];
    rows.insert(std::lower_bound(rows.begin(), rows.end(), row), row);
  }
  keep_up_to(std::numeric_limits<int>::max());
  std::swap(old, merged_);
}

ActiveMatrix::Candidate ActiveMatrix::best_in(int column) {
  PivotValues largest{};
  in_column_.clear();
  for (const int row : rows_in_[column]) {
    const PivotValues& values = rows_[row].at(column);
    in_column_.push_back(&values);
    for (int s = 0; s < kPivotStates; ++s) largest[s] = std::max(largest[s], std::abs(values[s]));
  }
  Candidate best;
  best.known = true;
  const PivotValues* const* values = in_column_.data();
  for (const int row : rows_in_[column]) {
    const PivotValues& pivot_values = **values++;
    Candidate candidate{true, row, (rows_[row].columns.size() - 1) * (rows_in_[column].size() - 1),
                        0};
    if (candidate.cost > best.cost) continue;
    candidate.share = least_share(pivot_values, largest);
    if (candidate.share >= threshold_ && candidate.before(best)) best = candidate;
  }
  return best;
}

}  // namespace misalign::solver
