// Estimates the acceptance rate from the populations of a splitting campaign, and its precision.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "schema/campaign/share_interval.hpp"

namespace misalign::schema {

/// Least number of populations for an interval.
inline constexpr std::size_t kLeastPopulations = 20;

struct SplitRate {
  std::size_t populations = 0;
  std::size_t reached = 0;  ///< populations that reached the top: their shares are above 0
  double mean = 0;
  double largest_part = 0;  ///< the largest share's part of the sum; 0 if none reached the top
  /// 95 % interval within [0, 1]; none from fewer than kLeastPopulations, or if none reached the
  /// top.
  std::optional<ShareInterval> interval;

  /// Returns half the interval's width over the mean.
  std::optional<double> relative_half_width() const;
};

/// Computes the rate of `shares`: unbiased estimates from populations, independent and identically
/// distributed; 0 if a population died. The result does not depend on their order or the machine:
/// it uses only + - * / and square roots.
///
/// Shares are skewed to the right, and so is the mean of few of them: Student's interval lies too
/// low. Hall's transformation removes the skewness g of the sample from T = sqrt(n) (mean - rate) /
/// s: T + g T^2 / (3 sqrt(n)) + g^2 T^3 / (27 n) + g / (6 sqrt(n)) is one to one, and normal to the
/// next order (P. Hall, On the removal of skewness by transformation, J. R. Statist. Soc. B 54,
/// 1992). Its quantiles are those of Student's t distribution, as usual for T itself.
///
/// Chosen by the coverage of intervals from 20 populations (results/splitting/unbiased.md): 95 to
/// 96 % with real populations, where Student's have 90 to 95 %; with longer tails, log-normal with
/// sigma = 1 (1.5), 92 % (89 %), Student's 87 % (77 %), Johnson's (J. Am. Stat. Assoc. 73, 1978)
/// 86 % (75 %), BCa's 88 % (81 %). Bootstrap-t covers as much, but one interval in a hundred is
/// several times as wide, or unbounded where few populations reach the top.
SplitRate split_rate(const std::vector<double>& shares);

/// Limits of a reliable rate. A third: without a population that has more, the estimate would fall
/// by as much. Ten at the top: their number alone is known to within a third. Campaigns that stop
/// as soon as both hold have intervals that cover the rate as often as others
/// (results/splitting/unbiased.md). A smaller part would not help, and is harmful with long tails:
/// waiting for the sum to outgrow its largest share is waiting for a time without large ones, which
/// ends in estimates that are too low.
inline constexpr double kLargestPart = 1.0 / 3;
inline constexpr std::size_t kLeastReached = 10;

/// Returns whether there is an interval and neither limit is missed.
bool has_converged(const SplitRate& rate);
/// Returns why the rate is not reliable yet, in words; empty if it is.
std::string why_not_converged(const SplitRate& rate);

}  // namespace misalign::schema
