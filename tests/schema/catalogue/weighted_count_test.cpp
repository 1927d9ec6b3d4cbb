#include "schema/catalogue/weighted_count.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace misalign::schema {
namespace {

struct WeightedRow {
  double weight;
  bool hit;
};

std::vector<WeightedRow> mixed_rows(std::mt19937_64& random, int rows, double p) {
  std::vector<WeightedRow> all;
  for (int k = 0; k < rows; ++k) {
    const double weight = static_cast<double>(std::uint64_t{1} << (10 + random() % 5));
    all.push_back({weight, std::uniform_real_distribution(0.0, 1.0)(random) < p});
  }
  return all;
}

WeightedCount counted(const std::vector<WeightedRow>& rows, bool hits_only) {
  WeightedCount sum;
  for (const WeightedRow& row : rows) {
    if (row.hit || !hits_only) sum += WeightedCount::of(1, row.weight);
  }
  return sum;
}

// Every row written out as the draws that it stands for.
TEST(WeightedCount, ShareIsThatOfTheDraws) {
  std::mt19937_64 random(11);
  const auto rows = mixed_rows(random, 200, 0.3);
  std::uint64_t draws = 0, hits = 0;
  for (const WeightedRow& row : rows) {
    for (int k = 0; k < static_cast<int>(row.weight); ++k) {
      ++draws;
      hits += row.hit;
    }
  }
  const WeightedCount all = counted(rows, false), part = counted(rows, true);
  EXPECT_EQ(all.rows, 200u);
  EXPECT_DOUBLE_EQ(all.draws, static_cast<double>(draws));
  EXPECT_DOUBLE_EQ(share(part, all), static_cast<double>(hits) / static_cast<double>(draws));
}

TEST(WeightedCount, RowsOfOneWeightAreCounted) {
  for (const double weight : {1.0, 1024.0, 65536.0}) {
    for (const std::uint64_t n : {1, 7, 300}) {
      for (const std::uint64_t k : {std::uint64_t{0}, n / 3, n - 1, n}) {
        const WeightedCount all = WeightedCount::of(n, weight), part = WeightedCount::of(k, weight);
        EXPECT_DOUBLE_EQ(all.effective(), static_cast<double>(n));
        const ShareInterval seen = share_interval(part, all), counted = share_interval(k, n);
        EXPECT_NEAR(seen.low, counted.low, 1e-12);
        EXPECT_NEAR(seen.high, counted.high, 1e-12);
      }
    }
  }
  EXPECT_EQ(share_interval(WeightedCount{}, WeightedCount{}), (ShareInterval{0, 1}));
  EXPECT_EQ(share({}, {}), 0);
}

// The variance of the share over many samples is p (1 - p) over the effective number, and the
// interval holds p at least as often as it says: plain counting of these rows would not.
TEST(WeightedCount, EffectiveNumberGivesTheVariance) {
  constexpr double p = 0.2;
  constexpr int kSamples = 3000;
  std::mt19937_64 random(12);
  double squares = 0, expected = 0;
  int held = 0;
  for (int k = 0; k < kSamples; ++k) {
    const auto rows = mixed_rows(random, 120, p);
    const WeightedCount all = counted(rows, false), part = counted(rows, true);
    const double off = share(part, all) - p;
    squares += off * off;
    expected += p * (1 - p) / all.effective();
    const ShareInterval interval = share_interval(part, all);
    held += interval.low <= p && p <= interval.high;
    ASSERT_LE(interval.low, share(part, all));
    ASSERT_GE(interval.high, share(part, all));
  }
  EXPECT_NEAR(squares / expected, 1, 0.1);
  EXPECT_GT(held, 0.945 * kSamples);
  EXPECT_LT(held, 0.985 * kSamples);
}

}  // namespace
}  // namespace misalign::schema
