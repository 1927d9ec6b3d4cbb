#include "schema/campaign/split_rate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <random>

namespace misalign::schema {
namespace {

constexpr double kScale = 1e-4;

using Law = std::function<double(std::mt19937_64&)>;

double exponential(std::mt19937_64& words) {
  return -std::log((static_cast<double>(words()) + 0.5) / 0x1p64);
}

std::vector<double> drawn(const Law& law, std::size_t populations, std::mt19937_64& words) {
  std::vector<double> shares(populations);
  for (double& share : shares) share = kScale * law(words);
  return shares;
}

double quantile(std::size_t populations) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(populations) - 1),
                               0.975);
}

TEST(SplitRate, CountsAndMean) {
  const SplitRate rate = split_rate({0.25, 0, 0.5, 0.25, 0});
  EXPECT_EQ(rate.populations, 5u);
  EXPECT_EQ(rate.reached, 3u);
  EXPECT_EQ(rate.mean, 0.2);
  EXPECT_EQ(rate.largest_part, 0.5);
}

TEST(SplitRate, NoIntervalFromTooFew) {
  EXPECT_FALSE(split_rate({}).interval);
  EXPECT_EQ(split_rate({}).mean, 0);
  EXPECT_FALSE(split_rate(std::vector<double>(kLeastPopulations - 1, 0.1)).interval);
  EXPECT_FALSE(split_rate(std::vector<double>(1000, 0)).interval);
  EXPECT_FALSE(split_rate(std::vector<double>(1000, 0)).relative_half_width());
  std::vector<double> one(kLeastPopulations, 0);
  one[7] = 1e-9;
  EXPECT_TRUE(split_rate(one).interval);
}

// Without spread there is nothing else that it could be.
TEST(SplitRate, EqualSharesAreTheRate) {
  const SplitRate rate = split_rate(std::vector<double>(32, 0.125));
  EXPECT_EQ(*rate.interval, (ShareInterval{0.125, 0.125}));
  EXPECT_EQ(*rate.relative_half_width(), 0);
}

// Without skewness the interval is Student's: shares m - d and m + d have s = d sqrt(n / (n - 1)).
TEST(SplitRate, SymmetricSharesHaveStudentsInterval) {
  for (const std::size_t n : {20, 50, 1000}) {
    std::vector<double> shares(n, 2e-3);
    std::fill(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(n / 2), 1e-3);
    const SplitRate rate = split_rate(shares);
    const double half = quantile(n) * 0.5e-3 / std::sqrt(static_cast<double>(n) - 1);
    EXPECT_NEAR(rate.interval->low, 1.5e-3 - half, 3e-5 * half) << n;
    EXPECT_NEAR(rate.interval->high, 1.5e-3 + half, 3e-5 * half) << n;
    EXPECT_NEAR(*rate.relative_half_width(), half / 1.5e-3, 3e-5 * half / 1.5e-3) << n;
  }
}

// The ends by their definition: there Hall's polynomial in T is Student's quantile.
TEST(SplitRate, EndsSolveHallsPolynomial) {
  std::mt19937_64 words(3);
  for (const std::size_t n : {20, 45, 300}) {
    const std::vector<double> shares = drawn(exponential, n, words);
    const SplitRate rate = split_rate(shares);
    double squares = 0, cubes = 0;
    for (const double share : shares) {
      squares += std::pow(share - rate.mean, 2);
      cubes += std::pow(share - rate.mean, 3);
    }
    const auto count = static_cast<double>(n);
    const double root = std::sqrt(count), s = std::sqrt(squares / (count - 1));
    const double g = cubes / count / std::pow(squares / count, 1.5);
    const auto transformed = [&](double end) {
      const double T = root * (rate.mean - end) / s;
      return T + g * T * T / (3 * root) + g * g * T * T * T / (27 * count) + g / (6 * root);
    };
    EXPECT_NEAR(transformed(rate.interval->low), quantile(n), 5e-5) << n;
    EXPECT_NEAR(transformed(rate.interval->high), -quantile(n), 5e-5) << n;
    EXPECT_GT(rate.interval->high - rate.mean, rate.mean - rate.interval->low) << n;
  }
}

TEST(SplitRate, OrderDoesNotMatter) {
  std::mt19937_64 words(4);
  std::vector<double> shares = drawn(exponential, 60, words);
  const SplitRate rate = split_rate(shares);
  for (int k = 0; k < 20; ++k) {
    std::ranges::shuffle(shares, words);
    const SplitRate again = split_rate(shares);
    EXPECT_EQ(again.mean, rate.mean);
    EXPECT_EQ(*again.interval, *rate.interval);
  }
}

TEST(SplitRate, StaysWithinShares) {
  std::vector<double> one(20, 0.0);
  one[0] = 1e-290;  // whose cube is no number above zero
  const SplitRate tiny = split_rate(one);
  EXPECT_EQ(tiny.interval->low, 0);
  EXPECT_GT(tiny.interval->high, tiny.mean);
  EXPECT_LT(*tiny.relative_half_width(), 10);
  one[0] = 1;
  one[1] = 0.9;
  one[2] = 1;
  std::fill(one.begin() + 3, one.end(), 0.95);
  one[3] = 0;
  EXPECT_LE(split_rate(one).interval->high, 1);
}

struct Coverage {
  double held, too_high, too_low;
};
Coverage coverage(const Law& law, double mean, std::size_t populations) {
  constexpr int kCampaigns = 4000;
  std::mt19937_64 words(5);
  Coverage coverage{1, 0, 0};
  for (int k = 0; k < kCampaigns; ++k) {
    const SplitRate rate = split_rate(drawn(law, populations, words));
    if (!rate.interval) continue;
    coverage.too_high += (rate.interval->low > kScale * mean) / (1.0 * kCampaigns);
    coverage.too_low += (rate.interval->high < kScale * mean) / (1.0 * kCampaigns);
  }
  coverage.held -= coverage.too_high + coverage.too_low;
  return coverage;
}

// Of 4,000: standard errors are 0.35 %. Exponential shares of which a fifth is 0 spread about as
// those of real populations do; squares of exponential ones have a tail that none of those had.
TEST(SplitRate, HoldsTheMeanOfSkewedLaws) {
  const Law with_zeros = [](std::mt19937_64& words) {
    const bool died = words() % 5 == 0;
    return died ? 0 : exponential(words);
  };
  const Law long_tail = [](std::mt19937_64& words) { return std::pow(exponential(words), 2); };
  for (const std::size_t n : {20, 50, 200}) {
    const Coverage usual = coverage(with_zeros, 0.8, n), tail = coverage(long_tail, 2, n);
    EXPECT_GT(usual.held, 0.93) << n;
    EXPECT_LT(usual.held, 0.975) << n;
    EXPECT_LT(usual.too_low, 0.045) << n;
    EXPECT_LT(usual.too_high, 0.035) << n;
    EXPECT_GT(tail.held, 0.9) << n;
    EXPECT_LT(tail.held, 0.98) << n;
  }
}

TEST(SplitRate, ConvergesOnBothSidesOfItsLimits) {
  const auto rate_of = [](std::size_t reached, double largest, std::size_t populations) {
    std::vector<double> shares(populations, 0);
    std::fill_n(shares.begin(), reached, 0.01);
    shares[0] = largest;
    return split_rate(shares);
  };
  EXPECT_TRUE(has_converged(rate_of(10, 0.01, 20)));
  EXPECT_FALSE(has_converged(rate_of(9, 0.01, 20)));
  EXPECT_FALSE(has_converged(rate_of(10, 0.01, 19)));
  EXPECT_TRUE(has_converged(rate_of(10, 0.0449, 20))) << "0.0449 of 0.1349";
  EXPECT_FALSE(has_converged(rate_of(10, 0.0451, 20)));
  EXPECT_FALSE(has_converged(split_rate({})));
}

}  // namespace
}  // namespace misalign::schema
