// Intervals for the mean of skewed shares, from the literature, and how often each holds it.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "schema/campaign/split_rate.hpp"

namespace misalign::bench {

using Shares = std::vector<double>;
using Interval = schema::ShareInterval;

struct SampleMoments {
  double mean, error, skewness;  ///< `error`: of the mean
};

inline SampleMoments sample_moments(const Shares& shares) {
  const auto n = static_cast<double>(shares.size());
  double mean = 0, squares = 0, cubes = 0;
  for (const double share : shares) mean += share / n;
  for (const double share : shares) {
    squares += std::pow(share - mean, 2) / n;
    cubes += std::pow(share - mean, 3) / n;
  }
  return {mean, std::sqrt(squares / (n - 1)), squares > 0 ? cubes / std::pow(squares, 1.5) : 0};
}

inline double student(const Shares& shares) {
  const auto n = static_cast<double>(shares.size());
  return boost::math::quantile(boost::math::students_t(n - 1), 0.975);
}

inline Interval student_interval(const Shares& shares) {
  const SampleMoments of = sample_moments(shares);
  const double half = student(shares) * of.error;
  return {of.mean - half, of.mean + half};
}

/// Of the logarithm of the mean, by the delta method.
inline Interval log_interval(const Shares& shares) {
  const SampleMoments of = sample_moments(shares);
  const double half = student(shares) * of.error / of.mean;
  return {of.mean * std::exp(-half), of.mean * std::exp(half)};
}

/// Johnson, J. Am. Stat. Assoc. 73, 1978: Student's, moved by what skewness moves t.
inline Interval johnson_interval(const Shares& shares) {
  const SampleMoments of = sample_moments(shares);
  const double t = student(shares), root = std::sqrt(static_cast<double>(shares.size()));
  const double middle = of.mean + of.skewness * of.error * (1 + 2 * t * t) / (6 * root);
  return {middle - t * of.error, middle + t * of.error};
}

inline constexpr int kResamples = 999;

inline std::vector<SampleMoments> resampled(const Shares& shares) {
  std::mt19937_64 words(7);
  std::vector<SampleMoments> all;
  Shares again(shares.size());
  for (int k = 0; k < kResamples; ++k) {
    for (double& share : again) share = shares[words() % shares.size()];
    all.push_back(sample_moments(again));
  }
  return all;
}

/// Efron and Tibshirani, An Introduction to the Bootstrap, 1993, 12.5.
inline Interval bootstrap_t_interval(const Shares& shares) {
  const SampleMoments of = sample_moments(shares);
  std::vector<double> t;
  for (const SampleMoments& one : resampled(shares)) {
    const double off = one.mean - of.mean;
    t.push_back(one.error > 0 ? off / one.error : std::copysign(HUGE_VAL, off));
  }
  std::ranges::sort(t);
  return {of.mean - t[974] * of.error, of.mean - t[24] * of.error};
}

/// BCa, 14.3 there.
inline Interval bca_interval(const Shares& shares) {
  const SampleMoments of = sample_moments(shares);
  std::vector<double> means;
  double below = 0;
  for (const SampleMoments& one : resampled(shares)) {
    means.push_back(one.mean);
    below += one.mean < of.mean ? 1 : one.mean == of.mean ? 0.5 : 0;
  }
  std::ranges::sort(means);
  const boost::math::normal normal;
  const double bias = boost::math::quantile(normal, std::clamp(below / kResamples, 0.001, 0.999));
  const double acceleration = of.skewness / (6 * std::sqrt(static_cast<double>(shares.size())));
  const auto end = [&](double part) {
    const double z = bias + boost::math::quantile(normal, part);
    const double place = boost::math::cdf(normal, bias + z / (1 - acceleration * z));
    return means[static_cast<std::size_t>(std::clamp(place * kResamples, 0.0, 998.0))];
  };
  return {end(0.025), end(0.975)};
}

inline Interval hall_interval(const Shares& shares) {
  const auto rate = schema::split_rate(shares);
  return rate.interval.value_or(Interval{0, 1});
}

/// Prints how often each holds `mean`, of samples that `draw` fills, with at least two shares > 0.
inline void print_coverage(const char* law, double mean, std::size_t populations,
                           std::uint64_t samples, const std::function<double()>& draw) {
  const std::vector<std::pair<const char*, Interval (*)(const Shares&)>> methods = {
      {"Student", student_interval},         {"Student, log", log_interval},
      {"Johnson", johnson_interval},         {"BCa", bca_interval},
      {"bootstrap-t", bootstrap_t_interval}, {"Hall", hall_interval}};
  std::vector<double> below(methods.size()), above(methods.size());
  std::vector<std::vector<double>> widths(methods.size());
  Shares shares(populations);
  for (std::uint64_t k = 0; k < samples; ++k) {
    do {
      std::ranges::generate(shares, draw);
    } while (std::ranges::count(shares, 0.0) + 1 >= static_cast<std::ptrdiff_t>(populations));
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Interval interval = methods[m].second(shares);
      below[m] += interval.high < mean;
      above[m] += interval.low > mean;
      widths[m].push_back((interval.high - std::max(interval.low, 0.0)) / 2 / mean);
    }
  }
  const double percent = 100.0 / static_cast<double>(samples);
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::ranges::sort(widths[m]);
    fmt::print(
        "{} {:3} {:12} holds {:5.1f} %, below {:4.1f}, above {:4.1f}, half width {:.2f}, "
        "one in a hundred {:.2g}\n",
        law, populations, methods[m].first, 100 - percent * (below[m] + above[m]),
        percent * below[m], percent * above[m], widths[m][samples / 2],
        widths[m][samples * 99 / 100]);
  }
}

/// The same of Hall's intervals, of campaigns that go on from kLeastPopulations until ten of theirs
/// have reached the top and none has more than this part of the sum.
inline void print_stopped(const char* law, double mean, double most_part, std::uint64_t samples,
                          const std::function<double()>& draw) {
  double held = 0, below = 0, populations = 0;
  for (std::uint64_t k = 0; k < samples; ++k) {
    Shares shares(schema::kLeastPopulations);
    std::ranges::generate(shares, draw);
    schema::SplitRate rate = schema::split_rate(shares);
    while (rate.largest_part > most_part || rate.reached < schema::kLeastReached) {
      shares.push_back(draw());
      rate = schema::split_rate(shares);
    }
    below += rate.interval->high < mean;
    held += rate.interval->low <= mean && mean <= rate.interval->high;
    populations += static_cast<double>(rate.populations);
  }
  const auto n = static_cast<double>(samples);
  fmt::print(
      "{} at most {:.2f} of the sum: after {:5.1f} populations, holds {:.1f} %, below {:.1f}\n",
      law, most_part, populations / n, 100 * held / n, 100 * below / n);
}

inline void print_law(const char* law, double mean, std::size_t populations, std::uint64_t samples,
                      const std::function<double()>& draw) {
  print_coverage(law, mean, populations, samples, draw);
  for (const double most_part : {0.5, 1.0 / 3, 0.25, 0.2, 0.1}) {
    print_stopped(law, mean, most_part, samples, draw);
  }
}

/// Of samples with replacement from all shares, whose mean they are to hold; and of log-normal
/// laws.
inline void compare_intervals(const Shares& all, std::size_t populations, std::uint64_t samples) {
  const SampleMoments of = sample_moments(all);
  const double died = static_cast<double>(std::ranges::count(all, 0.0));
  const auto n = static_cast<double>(all.size());
  fmt::print(
      "{} shares, standard deviation {:.2f} means, skewness {:.1f}, {:.1f} % zero, largest "
      "{:.1f} means\n",
      all.size(), of.error * std::sqrt(n - 1) / of.mean, of.skewness, 100 * died / n,
      std::ranges::max(all) / of.mean);
  std::mt19937_64 words(1);
  print_law("these", of.mean, populations, samples, [&] { return all[words() % all.size()]; });
  for (const double sigma : {1.0, 1.5}) {
    std::normal_distribution<double> normal(0, sigma);
    print_law(sigma == 1 ? "log-normal, 1  " : "log-normal, 1.5",
              1e-6 * std::exp(sigma * sigma / 2), populations, samples,
              [&] { return 1e-6 * std::exp(normal(words)); });
  }
}

}  // namespace misalign::bench
