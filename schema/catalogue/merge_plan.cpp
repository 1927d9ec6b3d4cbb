#include "schema/catalogue/merge_plan.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "schema/campaign/draw_ranges.hpp"

namespace misalign::schema {
namespace {

struct Unit {
  DrawRange range;
  std::size_t ledger;
};

// Returns for each unit, in the order of their ends, whether it belongs to the disjoint units that
// together have the most draws.
std::vector<bool> most_draws(const std::vector<Unit>& units) {
  const std::size_t count = units.size();
  assert(std::ranges::is_sorted(units, {}, [](const Unit& unit) { return unit.range.hi; }));
  // most[k]: draws of the best choice among the first k units; before[k]: number of units that end
  // where unit k begins or earlier.
  std::vector<std::uint64_t> most = {0};
  std::vector<std::size_t> before;
  for (std::size_t k = 0; k < count; ++k) {
    const auto first_later = std::upper_bound(
        units.begin(), units.begin() + static_cast<std::ptrdiff_t>(k), units[k].range.lo,
        [](std::uint64_t lo, const Unit& unit) { return lo < unit.range.hi; });
    before.push_back(static_cast<std::size_t>(first_later - units.begin()));
    most.push_back(std::max(most[k], most[before[k]] + units[k].range.size()));
  }
  std::vector<bool> chosen(count, false);
  for (std::size_t k = count; k > 0;) {
    if (most[k] == most[k - 1]) {
      --k;
    } else {
      chosen[k - 1] = true;
      k = before[k - 1];
    }
  }
  return chosen;
}

}  // namespace

MergePlan plan_merge(const std::vector<std::vector<DrawRange>>& ledgers) {
  std::vector<Unit> units;
  for (std::size_t ledger = 0; ledger < ledgers.size(); ++ledger) {
    for (const DrawRange& range : ledgers[ledger]) units.push_back({range, ledger});
  }
  std::stable_sort(units.begin(), units.end(),
                   [](const Unit& a, const Unit& b) { return a.range.hi < b.range.hi; });
  const std::vector<bool> chosen = most_draws(units);

  MergePlan plan{std::vector<std::vector<DrawRange>>(ledgers.size()),
                 std::vector<std::vector<DrawRange>>(ledgers.size()),
                 {}};
  std::vector<DrawRange> all, kept;
  for (std::size_t k = 0; k < units.size(); ++k) {
    all.push_back(units[k].range);
    if (chosen[k]) kept.push_back(units[k].range);
    (chosen[k] ? plan.kept : plan.compared)[units[k].ledger].push_back(units[k].range);
  }
  std::sort(all.begin(), all.end(),
            [](const DrawRange& a, const DrawRange& b) { return a.lo < b.lo; });
  plan.recomputed = without(united(all), kept);
  return plan;
}

}  // namespace misalign::schema
