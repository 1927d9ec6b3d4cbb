// Where a goal ends: the first granule that meets it, whatever the order in which units come.
#include "schema/campaign/goal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "schema/campaign/share_interval.hpp"

namespace misalign::schema {
namespace {

using Draws = std::set<std::uint64_t>;

// The definition, looked up at every granule.
std::uint64_t first_end(const Goal& goal, const Draws& accepted, const Draws& undecided,
                        std::uint64_t prefix_end) {
  if (goal.accepted == 0) return goal.range.lo;
  for (std::uint64_t n = kGoalGranule; goal.range.lo + n <= prefix_end; n += kGoalGranule) {
    const auto within = [&](const Draws& draws) {
      return static_cast<std::uint64_t>(
          std::distance(draws.lower_bound(goal.range.lo), draws.lower_bound(goal.range.lo + n)));
    };
    const std::uint64_t hits = within(accepted);
    const ShareInterval rate = share_interval(hits, within(undecided), n);
    const double share = static_cast<double>(hits) / static_cast<double>(n);
    const bool enough = goal.accepted && hits >= *goal.accepted;
    const bool known = goal.relative_error && hits > 0 &&
                       (rate.high - rate.low) / 2 <= *goal.relative_error * share;
    if (enough || known) return std::min(goal.range.lo + n, goal.planned_end());
  }
  return goal.planned_end();
}

std::vector<std::uint64_t> part(const Draws& draws, const DrawRange& range) {
  return {draws.lower_bound(range.lo), draws.lower_bound(range.hi)};
}

TEST(GoalEnd, IsTheFirstGranuleInAnyOrder) {
  const unsigned seed = 11;
  std::mt19937_64 random(seed);
  int met = 0, known = 0;
  for (int round = 0; round < 300; ++round) {
    const std::uint64_t total = 20 * kGoalGranule + random() % kGoalGranule;
    Draws accepted, undecided;
    // From one in 20,000 to nearly all.
    const double rate = std::pow(10, -4.3 + 4.28 * static_cast<double>(random() % 1000) / 999);
    std::bernoulli_distribution hit(rate), unknown(round % 3 == 0 ? rate / 30 : 0);
    for (std::uint64_t d = 0; d < total; ++d) {
      if (hit(random)) {
        accepted.insert(d);
      } else if (unknown(random)) {
        undecided.insert(d);
      }
    }
    Goal goal;
    goal.range.lo = round % 2 ? random() % 5000 : 0;
    if (round % 5 == 0) goal.draws = 10 * kGoalGranule + 7;
    if (round % 4 != 0) goal.relative_error = 0.02 + 0.01 * static_cast<double>(random() % 60);
    if (round % 4 != 1) goal.accepted = random() % (accepted.size() + 3);

    std::vector<DrawRange> units;
    for (std::uint64_t lo = 0; lo < total;) {
      const std::uint64_t hi = std::min(total, lo + 1 + random() % 9000);
      units.push_back({lo, hi});
      lo = hi;
    }
    std::shuffle(units.begin(), units.end(), random);
    GoalEnd end(goal);
    std::set<std::pair<std::uint64_t, std::uint64_t>> done;
    for (const DrawRange& unit : units) {
      end.add(unit, part(accepted, unit), part(undecided, unit));
      done.emplace(unit.lo, unit.hi);
      std::uint64_t prefix_end = goal.range.lo;
      for (const auto& [lo, hi] : done) {
        if (lo <= prefix_end) prefix_end = std::max(prefix_end, hi);
      }
      ASSERT_EQ(end.value(), first_end(goal, accepted, undecided, prefix_end))
          << "seed " << seed << ", round " << round << ", prefix " << prefix_end;
    }
    met += end.value() < goal.planned_end();
    known += end.value() < goal.planned_end() && !goal.accepted;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(known, 20);
}

// About 1 / error^2 * 1.96^2 accepted draws are needed where few are.
TEST(GoalEnd, RelativeErrorNeedsAsManyAsThePoissonLawSays) {
  Goal goal;
  goal.relative_error = 0.1;
  GoalEnd end(goal);
  std::uint64_t accepted = 0;
  for (std::uint64_t lo = 0; end.value() == kEndOfDraws && lo < 1000 * kGoalGranule;
       lo += kGoalGranule) {
    end.add({lo, lo + kGoalGranule}, {lo}, {});
    ++accepted;
  }
  EXPECT_NEAR(static_cast<double>(accepted), 1.96 * 1.96 / 0.01, 12);
  EXPECT_EQ(end.value(), accepted * kGoalGranule);
}

}  // namespace
}  // namespace misalign::schema
