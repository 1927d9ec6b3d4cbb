#include "search/status.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace misalign::search {
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

TEST(Status, IntervalIsClopperPearson) {
  for (const auto& [hits, trials] : {std::pair(3, 40), {20, 50}, {1, 1000}, {999, 1000}}) {
    const auto [low, high] =
        share_interval(static_cast<std::uint64_t>(hits), static_cast<std::uint64_t>(trials));
    EXPECT_NEAR(at_least(hits, trials, low), 0.025, 1e-9);
    EXPECT_NEAR(1 - at_least(hits + 1, trials, high), 0.025, 1e-9);
  }
}

// With no hit the upper end is 1 - 0.025^(1/n); without trials nothing is known.
TEST(Status, IntervalAtTheEnds) {
  EXPECT_EQ(share_interval(0, 1000).first, 0);
  EXPECT_NEAR(share_interval(0, 1000).second, 1 - std::pow(0.025, 1e-3), 1e-12);
  EXPECT_NEAR(share_interval(1000, 1000).first, std::pow(0.025, 1e-3), 1e-12);
  EXPECT_EQ(share_interval(1000, 1000).second, 1);
  EXPECT_EQ(share_interval(0, 0), std::pair(0.0, 1.0));
}

}  // namespace
}  // namespace misalign::search
