#include "schema/records/fault_sample.hpp"

#include <gtest/gtest.h>

#include <random>

namespace misalign::schema {
namespace {

const FaultSampleRule kRarer, kDense(3);

// The rule as the contract says it, in another way: k by doubling the border.
std::uint64_t contract_spacing(std::uint64_t draw) {
  std::uint64_t spacing = 1024, border = std::uint64_t{1} << 27;
  for (; draw >= border; border *= 2) spacing *= 2;
  return spacing;
}

TEST(FaultSampleRule, GetsRarerWithTheNumber) {
  constexpr unsigned kSeed = 5;
  std::mt19937_64 random(kSeed);
  const auto check = [&](std::uint64_t draw) {
    ASSERT_EQ(kRarer.spacing(draw), contract_spacing(draw)) << draw << ", seed " << kSeed;
    ASSERT_EQ(kRarer.holds(draw), draw % contract_spacing(draw) == 0) << draw;
    ASSERT_EQ(kDense.spacing(draw), 1024u);
    ASSERT_EQ(kDense.holds(draw), draw % 1024 == 0);
  };
  for (std::uint64_t draw = 0; draw < 5000; ++draw) check(draw);
  for (int m = 10; m < 63; ++m) {
    const std::uint64_t border = std::uint64_t{1} << m;
    for (std::uint64_t draw = border - 2050; draw != border + 5000; ++draw) {
      if (draw < kEndOfDraws) check(draw);
    }
    for (int k = 0; k < 100; ++k) check((border + random() % border) & ~std::uint64_t{1023});
  }
  check(kEndOfDraws - 1);
}

// At the edges, by hand.
TEST(FaultSampleRule, Edges) {
  constexpr std::uint64_t k2_27 = 134217728;
  EXPECT_TRUE(kRarer.holds(0));
  EXPECT_TRUE(kRarer.holds(k2_27 - 1024));
  EXPECT_TRUE(kRarer.holds(k2_27));
  EXPECT_FALSE(kRarer.holds(k2_27 + 1024));
  EXPECT_TRUE(kRarer.holds(k2_27 + 2048));
  EXPECT_TRUE(kRarer.holds(2 * k2_27 - 2048));
  EXPECT_FALSE(kRarer.holds(2 * k2_27 + 2048));
  EXPECT_TRUE(kDense.holds(2 * k2_27 + 2048));
  EXPECT_EQ(kRarer.spacing(k2_27 - 1024), 1024u);
  EXPECT_EQ(kRarer.spacing(k2_27), 2048u);
  EXPECT_EQ(kRarer.spacing(std::uint64_t{1} << 40), 1u << 24);
}

TEST(FaultSampleRule, RowsAreCounted) {
  constexpr std::uint64_t k2_27 = 134217728;
  EXPECT_EQ(kRarer.rows_below(0), 0u);
  EXPECT_EQ(kRarer.rows_below(1), 1u);
  EXPECT_EQ(kRarer.rows_below(1024), 1u);
  EXPECT_EQ(kRarer.rows_below(1025), 2u);
  EXPECT_EQ(kRarer.rows_below(k2_27), 131072u);
  EXPECT_EQ(kRarer.rows_below(2 * k2_27), 131072u + 65536u);
  // Another count of 10^12 draws: doubling by doubling.
  std::uint64_t rows = 131072;
  constexpr std::uint64_t kMany = 1000000000000;
  for (std::uint64_t lo = k2_27, every = 2048; lo < kMany; lo *= 2, every *= 2) {
    rows += (std::min(2 * lo, kMany) - lo + every - 1) / every;
  }
  EXPECT_EQ(kRarer.rows_below(kMany), rows);
  EXPECT_GT(rows, 900000u);
  EXPECT_LT(rows, 1100000u);
  EXPECT_EQ(kDense.rows_below(kMany), 976562500u);
  EXPECT_LT(kRarer.rows_below(kEndOfDraws), 2500000u);

  // Ranges across borders, one draw after the other.
  for (const int m : {26, 27, 28, 31, 40, 62}) {
    const std::uint64_t border = std::uint64_t{1} << m;
    for (const DrawRange range :
         {DrawRange{border - 9000, border + 9000}, DrawRange{border, border + 1},
          DrawRange{border + 1, border + 2}, DrawRange{border - 1, border + 5000}}) {
      for (const FaultSampleRule& rule : {kRarer, kDense}) {
        std::uint64_t held = 0;
        for (std::uint64_t draw = range.lo; draw < range.hi; ++draw) held += rule.holds(draw);
        EXPECT_EQ(rule.rows_in(range), held) << range.lo;
      }
    }
  }
  EXPECT_EQ(kRarer.rows_in({7, 7}), 0u);
}

// What the rows stand for is what there is: over a doubling exactly.
TEST(FaultSampleRule, WeightsAddUp) {
  for (const int m : {26, 27, 30, 40}) {
    const std::uint64_t lo = std::uint64_t{1} << m, hi = lo + (lo >> 6);
    std::uint64_t sum = 0;
    for (std::uint64_t draw = lo; draw < hi; draw += 1024) {
      if (kRarer.holds(draw)) sum += kRarer.spacing(draw);
    }
    EXPECT_EQ(sum, hi - lo) << m;
  }
}

}  // namespace
}  // namespace misalign::schema
