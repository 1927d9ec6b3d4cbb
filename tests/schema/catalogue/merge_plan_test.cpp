#include "schema/catalogue/merge_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace misalign::schema {
namespace {

using Ledgers = std::vector<std::vector<DrawRange>>;

TEST(MergePlan, WhatTouchesIsKept) {
  const MergePlan plan = plan_merge({{{0, 10}, {20, 30}}, {{10, 20}}, {{30, 40}}});
  EXPECT_EQ(plan.kept, (Ledgers{{{0, 10}, {20, 30}}, {{10, 20}}, {{30, 40}}}));
  EXPECT_EQ(plan.compared, (Ledgers{{}, {}, {}}));
  EXPECT_TRUE(plan.recomputed.empty());
}

TEST(MergePlan, EqualUnitsAreTakenOnceAndPartsAreMadeAgain) {
  const MergePlan plan = plan_merge({{{0, 10}, {10, 20}}, {{0, 10}, {15, 22}}});
  EXPECT_EQ(plan.kept, (Ledgers{{{0, 10}, {10, 20}}, {}}));
  EXPECT_EQ(plan.compared, (Ledgers{{}, {{0, 10}, {15, 22}}}));
  EXPECT_EQ(plan.recomputed, (std::vector<DrawRange>{{20, 22}}));
}

TEST(MergePlan, KeepsTheLargeUnitAndNotTheSmallOneInFrontOfIt) {
  const MergePlan plan = plan_merge({{{0, 10}, {10, 20}}, {{5, 1000}}});
  EXPECT_EQ(plan.kept, (Ledgers{{}, {{5, 1000}}}));
  EXPECT_EQ(plan.recomputed, (std::vector<DrawRange>{{0, 5}}));
}

// Against every choice there is, on small ledgers; and every draw is had exactly once.
TEST(MergePlan, LeavesTheFewestDraws) {
  const unsigned seed = 3;
  std::mt19937 random(seed);
  for (int round = 0; round < 400; ++round) {
    Ledgers ledgers(1 + random() % 3);
    std::vector<DrawRange> all;
    for (auto& ledger : ledgers) {
      for (std::uint64_t lo = random() % 8; lo < 30 && all.size() < 12;) {
        const std::uint64_t hi = lo + 1 + random() % 9;
        ledger.push_back({lo, hi});
        all.push_back({lo, hi});
        lo = hi + random() % 4;
      }
    }
    std::vector<int> held(60, 0), had(60, 0);
    for (const DrawRange& range : all) {
      for (auto d = range.lo; d < range.hi; ++d) held[d] = 1;
    }
    const MergePlan plan = plan_merge(ledgers);
    std::uint64_t kept = 0, units = 0;
    for (std::size_t k = 0; k < ledgers.size(); ++k) {
      for (const DrawRange& range : plan.kept[k]) {
        kept += range.size();
        for (auto d = range.lo; d < range.hi; ++d) ++had[d];
      }
      units += plan.kept[k].size() + plan.compared[k].size();
    }
    for (const DrawRange& range : plan.recomputed) {
      for (auto d = range.lo; d < range.hi; ++d) ++had[d];
    }
    ASSERT_EQ(had, held) << "seed " << seed << ", round " << round;
    ASSERT_EQ(units, all.size());
    std::uint64_t most = 0;
    for (unsigned chosen = 0; chosen < 1u << all.size(); ++chosen) {
      std::vector<int> times(60, 0);
      std::uint64_t draws = 0;
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (!(chosen >> k & 1)) continue;
        draws += all[k].size();
        for (auto d = all[k].lo; d < all[k].hi; ++d) ++times[d];
      }
      if (*std::max_element(times.begin(), times.end()) <= 1) most = std::max(most, draws);
    }
    ASSERT_EQ(kept, most) << "seed " << seed << ", round " << round;
  }
}

}  // namespace
}  // namespace misalign::schema
