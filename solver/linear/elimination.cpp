#include "solver/linear/elimination.hpp"

#include <map>
#include <utility>

namespace misalign::solver {
namespace {

int sign_of(std::vector<int> permutation) {
  int sign = 1;
  for (int i = 0; i < static_cast<int>(permutation.size()); ++i) {
    while (permutation[i] != i) {
      std::swap(permutation[i], permutation[permutation[i]]);
      sign = -sign;
    }
  }
  return sign;
}

// Rows and columns are in order; gives every nonzero its slot and lists what the numeric
// elimination will do.
void write_program(const std::vector<JacobianEntry>& entries, Elimination& plan) {
  const int n = plan.equations;
  std::vector<int> row_at(n), column_at(n + 1);
  for (int i = 0; i < n; ++i) row_at[plan.row_of[i]] = i;
  for (int i = 0; i <= n; ++i) column_at[plan.column_of[i]] = i;
  constexpr std::int32_t kFilled = -1;
  std::vector<std::map<int, std::int32_t>> slot(n);  // per row: column -> slot
  for (const JacobianEntry& entry : entries) slot[row_at[entry.row]][column_at[entry.column]] = 0;
  for (int i = 0; i < n; ++i) {
    slot[i].try_emplace(i, kFilled);
    for (auto at = slot[i].begin(); at->first < i; ++at) {
      const auto& above = slot[at->first];
      for (auto u = above.upper_bound(at->first); u != above.end(); ++u) {
        slot[i].try_emplace(u->first, kFilled);
      }
    }
    for (auto& [column, place] : slot[i]) {
      if (place == kFilled) plan.fill_slots.push_back(plan.slots);
      place = plan.slots++;
      plan.column.push_back(column);
    }
  }
  for (const JacobianEntry& entry : entries) {
    plan.slot_of_value.push_back(slot[row_at[entry.row]][column_at[entry.column]]);
  }
  const auto end = [](const auto& list) { return static_cast<std::int32_t>(list.size()); };
  for (int k = 0; k < n; ++k) {
    const std::int32_t pivot_slot = slot[k].at(k);
    const std::int32_t row_end = slot[k].rbegin()->second + 1;
    Pivot pivot{pivot_slot,
                {pivot_slot + 1, row_end},
                {end(plan.lower_slot), 0},
                {end(plan.above_slot), 0},
                end(plan.targets)};
    for (int i = 0; i < k; ++i) {
      const auto above = slot[i].find(k);
      if (above == slot[i].end()) continue;
      plan.above_slot.push_back(above->second);
      plan.above_row.push_back(i);
    }
    pivot.above.end = end(plan.above_slot);
    for (int i = k + 1; i < n; ++i) {
      const auto below = slot[i].find(k);
      if (below == slot[i].end()) continue;
      plan.lower_slot.push_back(below->second);
      plan.lower_row.push_back(i);
      for (auto u = slot[k].upper_bound(k); u != slot[k].end(); ++u) {
        plan.targets.push_back(slot[i].at(u->first));
      }
    }
    pivot.lower.end = end(plan.lower_slot);
    plan.pivots.push_back(pivot);
  }
}

}  // namespace

Elimination eliminate_in_order(const std::vector<JacobianEntry>& entries,
                               const std::vector<int>& row_of, const std::vector<int>& column_of) {
  Elimination plan{};
  plan.equations = static_cast<int>(row_of.size());
  plan.row_of = row_of;
  plan.column_of = column_of;
  plan.permutation_sign = sign_of(row_of) * sign_of({column_of.begin(), column_of.end() - 1});
  write_program(entries, plan);
  return plan;
}

}  // namespace misalign::solver
