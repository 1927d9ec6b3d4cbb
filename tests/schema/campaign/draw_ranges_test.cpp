// Sets of draws, by cases and against sets of single draws.
#include "schema/campaign/draw_ranges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace misalign::schema {
namespace {

TEST(DrawRanges, UnitedJoinsAndCuts) {
  struct Case {
    std::vector<DrawRange> ranges;
    std::uint64_t end;
    std::vector<DrawRange> merged;
  };
  const Case kCases[] = {
      {{}, 10, {}},
      {{{0, 5}}, 10, {{0, 5}}},
      {{{0, 5}, {5, 10}}, 10, {{0, 10}}},
      {{{0, 5}, {5, 7}, {7, 9}}, 100, {{0, 9}}},
      {{{0, 5}, {6, 10}}, 10, {{0, 5}, {6, 10}}},
      {{{0, 5}, {5, 10}}, 7, {{0, 7}}},
      {{{0, 5}, {5, 10}}, 5, {{0, 5}}},
      {{{0, 5}, {6, 10}}, 6, {{0, 5}}},
      {{{0, 7}, {2, 4}, {4, 9}}, 100, {{0, 9}}},
      {{{0, 9}, {1, 2}}, 100, {{0, 9}}},
      {{{3, 5}}, 3, {}},
      {{{3, 5}}, 0, {}},
      {{{0, 1}, {kEndOfDraws - 1, kEndOfDraws}},
       kEndOfDraws,
       {{0, 1}, {kEndOfDraws - 1, kEndOfDraws}}},
  };
  for (const Case& c : kCases) EXPECT_EQ(united(c.ranges, c.end), c.merged) << c.end;
}

TEST(DrawRanges, WithoutLeavesWhatNoOtherHas) {
  struct Case {
    std::vector<DrawRange> wanted, others, rest;
  };
  const Case kCases[] = {
      {{{0, 10}}, {}, {{0, 10}}},
      {{{0, 10}}, {{0, 10}}, {}},
      {{{0, 10}}, {{3, 5}}, {{0, 3}, {5, 10}}},
      {{{5, 10}}, {{0, 6}, {6, 8}, {9, 20}}, {{8, 9}}},
      {{{5, 10}, {20, 30}}, {{8, 25}}, {{5, 8}, {25, 30}}},
      {{{5, 5}}, {}, {}},
      {{{0, kEndOfDraws}}, {{0, kEndOfDraws - 1}}, {{kEndOfDraws - 1, kEndOfDraws}}},
  };
  for (const Case& c : kCases) EXPECT_EQ(without(c.wanted, c.others), c.rest);
}

std::set<std::uint64_t> draws_in(const std::vector<DrawRange>& ranges) {
  std::set<std::uint64_t> draws;
  for (const DrawRange& range : ranges) {
    for (std::uint64_t draw = range.lo; draw < range.hi; ++draw) draws.insert(draw);
  }
  return draws;
}

std::vector<DrawRange> random_ranges(std::mt19937& random, bool may_overlap) {
  std::vector<DrawRange> ranges;
  std::uint64_t at = 0;
  for (auto k = random() % 6; k > 0; --k) {
    const std::uint64_t lo = at + random() % 4, hi = lo + 1 + random() % 6;
    ranges.push_back({lo, hi});
    at = may_overlap ? lo : hi;
  }
  return ranges;
}

TEST(DrawRanges, AreSetsOfDraws) {
  std::mt19937 random(14);
  for (int k = 0; k < 2000; ++k) {
    const std::vector<DrawRange> a = random_ranges(random, true), b = random_ranges(random, false);
    const std::uint64_t end = random() % 40;
    std::set<std::uint64_t> below, rest;
    for (const std::uint64_t draw : draws_in(a)) {
      if (draw < end) below.insert(draw);
      if (!draws_in(b).contains(draw)) rest.insert(draw);
    }
    const std::vector<DrawRange> joined = united(a, end);
    EXPECT_EQ(draws_in(joined), below);
    for (std::size_t i = 1; i < joined.size(); ++i) EXPECT_GT(joined[i].lo, joined[i - 1].hi);
    EXPECT_EQ(draws_in(without(united(a), b)), rest);
  }
}

}  // namespace
}  // namespace misalign::schema
