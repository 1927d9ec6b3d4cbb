#include "search/sheets/least_change.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace misalign::search {
namespace {

// A requirement that is met from a value on, or up to it.
Judge met_beyond(double value, bool is_up) {
  return [=](double tried) {
    const double score = is_up ? tried - value : value - tried;
    return Judged{score >= 0, score};
  };
}

TEST(LeastChange, MeetsTheRequirementWithinAnEighthOfAFactor) {
  for (const double value : {2.001, 2.9, 7.5, 15.99}) {
    const auto found = least_change(1, 1 - value, {2, 1e-6, 1e6}, met_beyond(value, true));
    ASSERT_TRUE(found) << value;
    EXPECT_GE(*found, value);
    EXPECT_LE(*found, value * std::pow(2, 1.0 / 8)) << value;
    const auto least =
        least_change(1, 1 / value - 1, {0.5, 1e-6, 1e6}, met_beyond(1 / value, false));
    ASSERT_TRUE(least) << value;
    EXPECT_LE(*least, 1 / value);
    EXPECT_GE(*least, 1 / value / std::pow(2, 1.0 / 8)) << value;
  }
}

TEST(LeastChange, EndsAtALimitAndWhereItOnlyGetsWorse) {
  EXPECT_FALSE(least_change(1, -9, {2, 1e-6, 1e6}, met_beyond(17, true)));  // four factors are 16
  EXPECT_FALSE(least_change(1, -1, {2, 1e-6, 1.5}, met_beyond(2, true)));
  EXPECT_TRUE(least_change(1, -1, {2, 1e-6, 2}, met_beyond(2, true)));
  int tried = 0;
  const auto worse = [&](double value) {
    ++tried;
    return Judged{false, -value};
  };
  EXPECT_FALSE(least_change(1, -1, {2, 1e-6, 1e6}, worse));
  EXPECT_EQ(tried, 1);
}

TEST(TwoDigits, AreTheNextOnThatSide) {
  EXPECT_DOUBLE_EQ(two_digits(0.01234, Rounding::up), 0.013);
  EXPECT_DOUBLE_EQ(two_digits(0.01234, Rounding::down), 0.012);
  EXPECT_DOUBLE_EQ(two_digits(0.01254), 0.013);
  EXPECT_DOUBLE_EQ(two_digits(120, Rounding::up), 120);
  EXPECT_DOUBLE_EQ(two_digits(0.3, Rounding::down), 0.3);
  EXPECT_DOUBLE_EQ(two_digits(99.6, Rounding::up), 100);
}

}  // namespace
}  // namespace misalign::search
