// The acceptance rate from the populations of a splitting campaign, and how well it is known.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "schema/campaign/share_interval.hpp"

namespace misalign::schema {

/// The least number of populations from which an interval is made.
inline constexpr std::size_t kLeastPopulations = 20;

struct SplitRate {
  std::size_t populations = 0;
  std::size_t reached = 0;  ///< populations that came to the top: their shares are above 0
  double mean = 0;
  double largest_part = 0;  ///< the largest share's part of the sum; 0 where none reached the top
  /// 95 %, within [0, 1]. None from fewer than kLeastPopulations, or if none of them reached the
  /// top.
  std::optional<ShareInterval> interval;

  /// Half the interval's width over the mean.
  std::optional<double> relative_half_width() const;
};

/// `shares`: an unbiased estimate of the rate from each population, independent and all of one law;
/// 0 where a population died. Their order does not matter, and every machine gives the same bits:
/// there is nothing but + - * / and square roots in it.
///
/// Shares are skewed to the right, and the mean of few of them is, too: Student's interval lies too
/// low. Hall's transformation takes the skewness g of the sample out of T = sqrt(n) (mean - rate) /
/// s: T + g T^2 / (3 sqrt(n)) + g^2 T^3 / (27 n) + g / (6 sqrt(n)) is one to one, and normal to the
/// next order (P. Hall, On the removal of skewness by transformation, J. R. Statist. Soc. B 54,
/// 1992). Its quantiles are taken from Student's law, as is usual for T itself.
///
/// Chosen by what intervals from 20 populations hold, drawn from the 8,000 of each campaign of
/// results/splitting/unbiased.md, where the table is; and from 20 of laws with heavier tails. Of
/// log-normal shares with sigma = 1 (1.5), 92 % (89 %) of Hall's intervals hold the mean, 86 %
/// (76 %) of Student's, 86 % (75 %) of Johnson's (1978), 86 % (80 %) of BCa's. Bootstrap-t comes
/// near (91 %, 88 %), but has ends without bound where few populations reach the top.
SplitRate split_rate(const std::vector<double>& shares);

/// What must be the case before a rate is believed. A third: where one population is more, the
/// estimate would change by half without it. Ten at the top: their number alone is known to within
/// a third. Campaigns that stop as soon as both hold have intervals that hold the rate as often as
/// any (results/splitting/unbiased.md). A lower part would be worse: waiting for the sum to outgrow
/// its largest share is waiting for a time without large ones, and ends in estimates that are low.
inline constexpr double kLargestPart = 1.0 / 3;
inline constexpr std::size_t kLeastReached = 10;

/// Whether there is an interval and neither limit is missed.
bool has_converged(const SplitRate& rate);

}  // namespace misalign::schema
