#include "solver/linear/elimination.hpp"

#include <algorithm>
#include <cassert>
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

// Columns of the factors' nonzeros, row by row: those of the matrix and the fill from rows above.
std::vector<std::vector<int>> columns_of_factors(const std::vector<std::vector<int>>& columns_of,
                                                 int n) {
  std::vector<std::vector<int>> filled(n);
  std::vector<char> is_in(n + 1);
  for (int i = 0; i < n; ++i) {
    std::fill(is_in.begin(), is_in.end(), false);
    for (const int column : columns_of[i]) is_in[column] = true;
    is_in[i] = true;
    for (int k = 0; k < i; ++k) {
      if (!is_in[k]) continue;
      const auto beyond = std::upper_bound(filled[k].begin(), filled[k].end(), k);
      for (auto u = beyond; u != filled[k].end(); ++u) is_in[*u] = true;
    }
    for (int column = 0; column <= n; ++column) {
      if (is_in[column]) filled[i].push_back(column);
    }
  }
  return filled;
}

std::int32_t end_of(const std::vector<std::int32_t>& list) {
  return static_cast<std::int32_t>(list.size());
}

// Gives every nonzero its slot; rows and columns are in order already.
void give_slots(const std::vector<JacobianEntry>& entries, Elimination& plan) {
  const int n = plan.equations;
  std::vector<int> row_at(n), column_at(n + 1);
  for (int i = 0; i < n; ++i) row_at[plan.row_of[i]] = i;
  for (int i = 0; i <= n; ++i) column_at[plan.column_of[i]] = i;
  std::vector<std::vector<int>> columns_of(n);
  for (const JacobianEntry& entry : entries) {
    columns_of[row_at[entry.row]].push_back(column_at[entry.column]);
  }
  std::vector<std::int32_t> first_slot{0};
  for (const auto& columns : columns_of_factors(columns_of, n)) {
    plan.column.insert(plan.column.end(), columns.begin(), columns.end());
    first_slot.push_back(end_of(plan.column));
  }
  plan.slots = end_of(plan.column);
  const auto slot_at = [&](int i, int j) {
    const auto row = plan.column.begin() + first_slot[i],
               end = plan.column.begin() + first_slot[i + 1];
    assert(std::binary_search(row, end, j));
    return static_cast<std::int32_t>(std::lower_bound(row, end, j) - plan.column.begin());
  };
  for (const JacobianEntry& entry : entries) {
    plan.slot_of_value.push_back(slot_at(row_at[entry.row], column_at[entry.column]));
  }
  for (int k = 0; k < n; ++k) {
    const std::int32_t slot = slot_at(k, k);
    plan.pivots.push_back({slot, {slot + 1, first_slot[k + 1]}, {}, {}});
  }
}

// Lists the factors' columns, above and below each pivot.
void list_columns(Elimination& plan) {
  const int n = plan.equations;
  struct Slots {
    std::vector<std::int32_t> above_slot, above_row, lower_slot, lower_row;
  };
  std::vector<Slots> columns(n + 1);
  std::int32_t slot = 0;
  for (int i = 0; i < n; ++i) {
    for (; slot < plan.pivots[i].upper.end; ++slot) {
      Slots& column = columns[plan.column[slot]];
      if (plan.column[slot] > i) {
        column.above_slot.push_back(slot);
        column.above_row.push_back(i);
      } else if (plan.column[slot] < i) {
        column.lower_slot.push_back(slot);
        column.lower_row.push_back(i);
      }
    }
  }
  const auto append = [](const std::vector<std::int32_t>& from, std::vector<std::int32_t>& to) {
    const std::int32_t begin = end_of(to);
    to.insert(to.end(), from.begin(), from.end());
    return Elimination::Range{begin, end_of(to)};
  };
  for (int k = 0; k < n; ++k) {
    plan.pivots[k].above = append(columns[k].above_slot, plan.above_slot);
    append(columns[k].above_row, plan.above_row);
    plan.pivots[k].lower = append(columns[k].lower_slot, plan.lower_slot);
    append(columns[k].lower_row, plan.lower_row);
  }
}

// Returns whether pivot k + 1 has the rows below and the columns beyond of pivot k, except its own.
bool goes_on(const Elimination& plan, int k) {
  assert(k >= 0 && k + 1 < plan.equations);
  const Elimination::Pivot &a = plan.pivots[k], &b = plan.pivots[k + 1];
  const auto row = plan.lower_row.begin();
  const auto column = plan.column.begin();
  return a.lower.size() == b.lower.size() + 1 && a.upper.size() == b.upper.size() + 1 &&
         row[a.lower.begin] == k + 1 && column[a.upper.begin] == k + 1 &&
         std::equal(row + b.lower.begin, row + b.lower.end, row + a.lower.begin + 1) &&
         std::equal(column + b.upper.begin, column + b.upper.end, column + a.upper.begin + 1);
}

// Smallest block in multiplications: smaller ones are as fast pivot by pivot. On 6 x 6 panels none
// pays.
constexpr int kLeastBlock = 600;

Elimination::Block block_from(const Elimination& plan, std::int32_t first) {
  std::int32_t end = first + 1;
  while (end < plan.equations && goes_on(plan, end - 1)) ++end;
  const Elimination::Pivot& pivot = plan.pivots[first];
  if ((end - first) * pivot.upper.size() * pivot.lower.size() < kLeastBlock) end = first + 1;
  const Elimination::Pivot& last = plan.pivots[end - 1];
  return {first, end, last.upper, last.lower, {}, end_of(plan.targets)};
}

void find_blocks(Elimination& plan) {
  assert(std::ssize(plan.pivots) == plan.equations);
  std::vector<char> is_filled(plan.slots);
  for (const std::int32_t slot : plan.slot_of_value) is_filled[slot] = true;
  const auto fill = [&](std::int32_t slot) {
    if (!is_filled[slot]) plan.fill_slots.push_back(slot);
    is_filled[slot] = true;
  };
  while (plan.blocks.empty() || plan.blocks.back().end < plan.equations) {
    Elimination::Block block = block_from(plan, plan.blocks.empty() ? 0 : plan.blocks.back().end);
    block.fill.begin = end_of(plan.fill_slots);
    for (std::int32_t k = block.first; k < block.end; ++k) {
      const Elimination::Pivot& pivot = plan.pivots[k];
      for (std::int32_t s = pivot.slot - (k - block.first); s < pivot.upper.end; ++s) fill(s);
    }
    for (std::int32_t k = block.lower.begin; k < block.lower.end; ++k) {
      std::int32_t target = plan.lower_slot[k];
      for (int j = 0; j < block.size(); ++j) fill(target - j);
      for (std::int32_t u = block.upper.begin; u < block.upper.end; ++u) {
        while (plan.column[target] != plan.column[u]) ++target;
        plan.targets.push_back(target);
        fill(target);
      }
    }
    block.fill.end = end_of(plan.fill_slots);
    assert(block.end > block.first);
    if (block.size() > 1) {
      plan.most_packed = std::max(plan.most_packed, block.size() * block.upper.size());
    }
    plan.blocks.push_back(block);
  }
}

}  // namespace

Elimination eliminate_in_order(const std::vector<JacobianEntry>& entries,
                               const std::vector<int>& row_of, const std::vector<int>& column_of) {
  Elimination plan{};
  assert(column_of.size() == row_of.size() + 1);
  plan.equations = static_cast<int>(row_of.size());
  plan.row_of = row_of;
  plan.column_of = column_of;
  plan.permutation_sign = sign_of(row_of) * sign_of({column_of.begin(), column_of.end() - 1});
  give_slots(entries, plan);
  list_columns(plan);
  find_blocks(plan);
  return plan;
}

std::size_t Elimination::operations() const {
  std::size_t sum = 0;
  for (const Pivot& pivot : pivots) {
    sum +=
        static_cast<std::size_t>(pivot.lower.size()) * static_cast<std::size_t>(pivot.upper.size());
  }
  return sum;
}

}  // namespace misalign::solver
