// The end of a goal: the first granule that meets it, or the first twenty populations, whatever the
// order in which units come.
#include "schema/campaign/goal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "schema/campaign/share_interval.hpp"
#include "schema/campaign/split_rate.hpp"
#include "schema/campaign/splitting.hpp"

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

// ---- Of populations ----

using Shares = std::vector<double>;

constexpr std::uint64_t kPopulation = kNumbersOfPopulation;

Goal goal_of_populations(double relative_error) {
  Goal goal;
  goal.of_populations = true;
  goal.relative_error = relative_error;
  return goal;
}

DrawRange numbers_of_one(std::uint64_t population) {
  return numbers_of({population, population + 1});
}

void add_all(const Shares& shares, GoalEnd& end) {
  for (std::size_t k = 0; k < shares.size(); ++k) end.add_population(numbers_of_one(k), shares[k]);
}

bool is_known(const Goal& goal, const Shares& all, std::size_t first, std::size_t count) {
  const auto from = all.begin() + static_cast<std::ptrdiff_t>(first);
  const SplitRate rate = split_rate({from, from + static_cast<std::ptrdiff_t>(count)});
  return has_converged(rate) && *rate.relative_half_width() <= *goal.relative_error;
}

// The definition, looked up at every multiple: of populations `first` to `prefix_end` - 1 none is
// missing.
std::uint64_t end_of_populations(const Goal& goal, const Shares& all, std::size_t first,
                                 std::size_t prefix_end) {
  for (std::size_t n = 20; goal.relative_error && first + n <= prefix_end; n += 20) {
    if (is_known(goal, all, first, n))
      return std::min((first + n) * kPopulation, goal.planned_end());
  }
  return goal.planned_end();
}

TEST(GoalEnd, OfPopulationsIsTheFirstMultipleInAnyOrder) {
  const unsigned seed = 12;
  std::mt19937_64 random(seed);
  int met = 0, later = 0;
  for (int round = 0; round < 120; ++round) {
    // Some die, the others' shares have a long tail.
    std::bernoulli_distribution dies(0.1 * static_cast<double>(round % 8));
    std::lognormal_distribution<double> share(-9, 0.1 + 0.1 * static_cast<double>(round % 10));
    Shares all(130);
    for (double& one : all) one = dies(random) ? 0 : std::min(1.0, share(random));
    Goal goal = goal_of_populations(0.05 + 0.01 * static_cast<double>(random() % 60));
    const std::size_t first = round % 2 ? random() % 9 : 0;
    goal.range.lo = first * kPopulation;
    if (round % 5 == 0) goal.draws = 50 * kPopulation;
    std::vector<std::size_t> order(all.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::shuffle(order.begin(), order.end(), random);
    GoalEnd end(goal);
    std::set<std::size_t> done;
    std::size_t prefix_end = first;
    for (const std::size_t population : order) {
      end.add_population(numbers_of_one(population), all[population]);
      done.insert(population);
      while (done.contains(prefix_end)) ++prefix_end;
      ASSERT_EQ(end.value(), end_of_populations(goal, all, first, prefix_end))
          << "seed " << seed << ", round " << round << ", prefix " << prefix_end;
    }
    met += end.value() < goal.planned_end();
    later += end.value() < goal.planned_end() && end.value() > goal.range.lo + 20 * kPopulation;
  }
  EXPECT_GT(met, 40);
  EXPECT_GT(later, 15);
}

// Twenty equal shares are an interval without width.
TEST(GoalEnd, OnePopulationThatIsMissingHoldsItBack) {
  GoalEnd end(goal_of_populations(0.1));
  for (std::uint64_t population = 0; population < 45; ++population) {
    if (population != 3) end.add_population(numbers_of_one(population), 0.25);
    EXPECT_EQ(end.value(), kEndOfDraws) << population;
  }
  end.add_population(numbers_of_one(3), 0.25);
  EXPECT_EQ(end.value(), 20 * kPopulation);
  end.add_population(numbers_of_one(45), 0);
  EXPECT_EQ(end.value(), 20 * kPopulation);
}

// A rate that one population makes up is none; three more such ones make it one, from 23
// populations on, but nobody looks before there are 40.
TEST(GoalEnd, PopulationsAreLookedAtByTwenties) {
  const Goal goal = goal_of_populations(10);
  Shares all(39, 0.01);
  for (const std::size_t k : {0, 20, 21, 22}) all[k] = 0.9;
  EXPECT_FALSE(is_known(goal, all, 0, 20));
  for (std::size_t n = 23; n < 40; ++n) EXPECT_TRUE(is_known(goal, all, 0, n)) << n;
  GoalEnd end(goal);
  add_all(all, end);
  EXPECT_EQ(end.value(), kEndOfDraws);
  end.add_population(numbers_of_one(39), 0.01);
  EXPECT_EQ(end.value(), 40 * kPopulation);
}

// Half the interval over the mean, on both sides of what was wanted. Where all but a few died the
// rate is not believed, however wide a rate is wanted.
TEST(GoalEnd, PopulationsEndWhereTheRateIsNarrowEnough) {
  Shares all(20, 0.001);
  for (std::size_t k = 0; k < 10; ++k) all[k] = 0.003;
  const double width = *split_rate(all).relative_half_width();
  EXPECT_NEAR(width, 2.093 * 0.5 / std::sqrt(19), 0.02);  // Student's of 19, no skewness
  for (const double wanted : {width * 0.999, width * 1.001}) {
    GoalEnd end(goal_of_populations(wanted));
    add_all(all, end);
    EXPECT_EQ(end.value(), wanted < width ? kEndOfDraws : 20 * kPopulation) << wanted;
  }
  Shares few(60, 0);
  for (std::size_t k = 0; k < 9; ++k) few[k] = 0.001;
  GoalEnd of_few(goal_of_populations(100));
  add_all(few, of_few);
  EXPECT_EQ(of_few.value(), kEndOfDraws);
}

// A goal of so many populations, with a rate or without; what populations met is no goal.
TEST(GoalEnd, PopulationsAreCounted) {
  const Shares all(60, 0.25);
  Goal goal;
  goal.of_populations = true;
  goal.range = {5 * kPopulation, 900 * kPopulation};
  goal.draws = 30 * kPopulation;
  for (const std::optional<double> error : {std::optional<double>(), std::optional(0.1)}) {
    for (const std::optional<std::uint64_t> accepted :
         {std::optional<std::uint64_t>(), std::optional<std::uint64_t>(0)}) {
      goal.relative_error = error;
      goal.accepted = accepted;
      GoalEnd end(goal);
      EXPECT_EQ(end.value(), 35 * kPopulation);
      add_all(all, end);
      EXPECT_EQ(end.value(), (error ? 25 : 35) * kPopulation);
    }
  }
  goal.relative_error.reset();
  goal.accepted = 1;
  goal.draws = 2000 * kPopulation;
  GoalEnd end(goal);
  add_all(all, end);
  EXPECT_EQ(end.value(), 900 * kPopulation);
}

}  // namespace
}  // namespace misalign::schema
