// Campaigns of splitting that go on until their rate is known well enough: how far off that is on
// average, and how often the interval holds.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "schema/campaign/goal.hpp"
#include "schema/campaign/splitting.hpp"
#include "tests/bench/share_intervals.hpp"

namespace misalign::bench {

struct StoppedOptions {
  double relative_error;
  std::size_t look_every = schema::kGoalPopulations;
  std::size_t least = 0;    ///< populations before the first look
  std::size_t most = 5000;  ///< then it stops without having met its goal
};

/// The shares of one campaign up to where the program's goal ends it.
inline Shares shares_to_goal(const StoppedOptions& options, const std::function<double()>& draw) {
  schema::Goal goal;
  goal.range = schema::numbers_of({0, options.most});
  goal.relative_error = options.relative_error;
  goal.of_populations = true;
  schema::GoalEnd end(goal);
  Shares shares;
  for (std::uint64_t r = 0; schema::numbers_of({0, r}).hi < end.value(); ++r) {
    shares.push_back(draw());
    end.add_population(schema::numbers_of({r, r + 1}), shares.back());
  }
  return shares;
}

/// The same with other looks: by the inequality of GoalEnd, at each multiple of `look_every`.
inline Shares shares_to_look(const StoppedOptions& options, const std::function<double()>& draw) {
  Shares shares;
  while (shares.size() < options.most) {
    shares.push_back(draw());
    if (shares.size() % options.look_every != 0 || shares.size() < options.least) continue;
    const schema::SplitRate rate = schema::split_rate(shares);
    if (has_converged(rate) && *rate.relative_half_width() <= options.relative_error) break;
  }
  return shares;
}

using Draw = std::function<double()>;

/// Prints what such campaigns end with, whose shares have this mean; returns their mean number of
/// populations.
inline double print_ends(const std::string& what, double mean, std::uint64_t samples,
                         const std::function<Shares()>& campaign) {
  Shares means;
  double below = 0, above = 0, populations = 0;
  for (std::uint64_t k = 0; k < samples; ++k) {
    const schema::SplitRate rate = schema::split_rate(campaign());
    means.push_back(rate.mean / mean);
    populations += static_cast<double>(rate.populations);
    below += rate.interval && rate.interval->high < mean;
    above += rate.interval && rate.interval->low > mean;
  }
  const SampleMoments of = sample_moments(means);
  const auto n = static_cast<double>(samples);
  fmt::print(
      "{}: bias {:+.2f} +- {:.2f} %, holds {:.1f} %, below {:.1f}, above {:.1f}, after {:.1f} "
      "populations\n",
      what, 100 * (of.mean - 1), 100 * of.error, 100 - 100 * (below + above) / n, 100 * below / n,
      100 * above / n, populations / n);
  return populations / n;
}

/// Of a law: with the program's looks, with one after every population, with a later first one; and
/// with as many populations as the first have on average, whatever they give.
inline void print_goals(const std::string& law, double mean, const std::vector<double>& errors,
                        std::uint64_t samples, const Draw& draw) {
  for (const double error : errors) {
    const auto print = [&](const char* looks, const std::function<Shares()>& campaign) {
      return print_ends(fmt::format("{}, error {}, {}", law, error, looks), mean, samples,
                        campaign);
    };
    const double populations = print("every 20", [&] { return shares_to_goal({error}, draw); });
    print("every one", [&] { return shares_to_look({error, 1}, draw); });
    print("every 20 from 40", [&] { return shares_to_look({error, 20, 40}, draw); });
    print("every 20 from 100", [&] { return shares_to_look({error, 20, 100}, draw); });
    print("no look", [&] {
      Shares shares(static_cast<std::size_t>(std::lround(populations)));
      std::ranges::generate(shares, draw);
      return shares;
    });
  }
}

/// Of samples with replacement from all shares, whose mean is their rate; or, with a `sigma`, of a
/// log-normal law instead.
inline void compare_goals(const Shares& all, double sigma, std::uint64_t samples) {
  std::mt19937_64 words(2);
  if (sigma > 0) {
    std::normal_distribution<double> normal(0, sigma);
    print_goals(fmt::format("log-normal, {}", sigma), 1e-6 * std::exp(sigma * sigma / 2),
                {0.5, 0.3, 0.2}, samples, [&] { return 1e-6 * std::exp(normal(words)); });
  } else {
    print_goals("these", sample_moments(all).mean, {0.5, 0.3, 0.2, 0.1}, samples,
                [&] { return all[words() % all.size()]; });
  }
}

}  // namespace misalign::bench
