#include "schema/campaign/share_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace misalign::schema {
namespace {

// The defining property, by summing the binomial distribution: at the lower end of the interval
// `hits` or more have probability 2.5 %, at the upper end `hits` or fewer.
double at_least(int hits, int trials, double p) {
  double sum = 0;
  for (int k = hits; k <= trials; ++k) {
    sum +=
        std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) - std::lgamma(trials - k + 1.0) +
                 k * std::log(p) + (trials - k) * std::log1p(-p));
  }
  return sum;
}

TEST(ShareInterval, IntervalIsClopperPearson) {
  for (const auto& [hits, trials] : {std::pair(3, 40), {20, 50}, {1, 1000}, {999, 1000}}) {
    const auto [low, high] =
        share_interval(static_cast<std::uint64_t>(hits), static_cast<std::uint64_t>(trials));
    EXPECT_NEAR(at_least(hits, trials, low), 0.025, 1e-9);
    EXPECT_NEAR(1 - at_least(hits + 1, trials, high), 0.025, 1e-9);
  }
}

// One end only, which none (or all) of n hit with probability 5 %: the rule of three; without
// trials nothing is known.
TEST(ShareInterval, AtTheEnds) {
  EXPECT_EQ(share_interval(0, 1000).low, 0);
  EXPECT_NEAR(std::pow(1 - share_interval(0, 1000).high, 1000), 0.05, 1e-12);
  EXPECT_NEAR(share_interval(0, 1000000).high, 3e-6, 0.01e-6);
  EXPECT_NEAR(std::pow(share_interval(1000, 1000).low, 1000), 0.05, 1e-12);
  EXPECT_EQ(share_interval(1000, 1000).high, 1);
  EXPECT_EQ(share_interval(0, 0), (ShareInterval{0, 1}));
}

TEST(ShareInterval, UndecidedBoundBothWays) {
  EXPECT_EQ(share_interval(20, 0, 50), share_interval(20, 50));
  const ShareInterval both = share_interval(20, 7, 50);
  EXPECT_EQ(both.low, share_interval(20, 50).low);
  EXPECT_EQ(both.high, share_interval(27, 50).high);
}

}  // namespace
}  // namespace misalign::schema
