// The acceptance rate from the populations of a splitting campaign, and how well it is known.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
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
/// Chosen by what intervals from 20 populations hold (results/splitting/unbiased.md): of real
/// populations 95 to 96 %, where Student's hold 90 to 95 %; of laws with longer tails, log-normal
/// with sigma = 1 (1.5), 92 % (89 %), Student's 87 % (77 %), Johnson's (J. Am. Stat. Assoc. 73,
/// 1978) 86 % (75 %), BCa's 88 % (81 %). Bootstrap-t holds as much, but one interval in a hundred
/// is several times as wide, or without bound where few populations reach the top.
SplitRate split_rate(const std::vector<double>& shares);

/// What must be the case before a rate is believed. A third: of a population with more, the
/// estimate would fall by as much without it. Ten at the top: their number alone is known to within
/// a third. Campaigns that stop as soon as both hold have intervals that hold the rate as often as
/// others (results/splitting/unbiased.md). A lower part would help no more, and with long tails it
/// does harm: to wait for the sum to outgrow its largest share is to wait for a time without large
/// ones, which ends in estimates that are too low.
inline constexpr double kLargestPart = 1.0 / 3;
inline constexpr std::size_t kLeastReached = 10;

/// Whether there is an interval and neither limit is missed.
bool has_converged(const SplitRate& rate);
/// Why the rate is not to be believed yet, in words; empty if it is.
std::string why_not_converged(const SplitRate& rate);

}  // namespace misalign::schema
