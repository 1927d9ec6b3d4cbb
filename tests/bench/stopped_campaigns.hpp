// Campaigns of splitting that go on until their rate is known well enough: how far off that is on
// average, and how often the interval holds.
#pragma once

#include <fmt/format.h>

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

/// Prints what campaigns whose populations `draw` gives end with, of a law with this mean.
inline void print_goal(const std::string& law, double mean, const StoppedOptions& options,
                       std::uint64_t samples, const std::function<double()>& draw) {
  const bool as_program = options.look_every == schema::kGoalPopulations && options.least == 0;
  Shares means;
  double below = 0, above = 0, populations = 0, unmet = 0, first = 0;
  for (std::uint64_t k = 0; k < samples; ++k) {
    const Shares shares =
        as_program ? shares_to_goal(options, draw) : shares_to_look(options, draw);
    const schema::SplitRate rate = schema::split_rate(shares);
    means.push_back(rate.mean / mean);
    populations += static_cast<double>(rate.populations);
    unmet += rate.populations == options.most;
    first += rate.populations == schema::kGoalPopulations;
    if (!rate.interval) continue;
    below += rate.interval->high < mean;
    above += rate.interval->low > mean;
  }
  const SampleMoments of = sample_moments(means);
  const double percent = 100.0 / static_cast<double>(samples);
  fmt::print(
      "{:15} error {:.2f} every {:2} least {:3}: bias {:+6.2f} +- {:.2f} %, holds {:5.1f} %, below "
      "{:4.1f}, above {:4.1f}, after {:6.1f} populations, {:5.1f} % after 20, {:.1f} % unmet\n",
      law, options.relative_error, options.look_every, options.least, 100 * (of.mean - 1),
      100 * of.error, 100 - percent * (below + above), percent * below, percent * above,
      populations / static_cast<double>(samples), percent * first, percent * unmet);
}

/// Of a law: the program's looks, one after every population, and a later first one.
inline void print_goals(const std::string& law, double mean, std::uint64_t samples,
                        const std::function<double()>& draw) {
  for (const double error : {0.5, 0.3, 0.2, 0.1}) {
    print_goal(law, mean, {error}, samples, draw);
    print_goal(law, mean, {error, 1}, samples, draw);
    for (const std::size_t least : {40, 100}) {
      print_goal(law, mean, {error, schema::kGoalPopulations, least}, samples, draw);
    }
  }
}

/// Of samples with replacement from all shares, whose mean is their rate; or, with a `sigma`, of a
/// log-normal law instead.
inline void compare_goals(const Shares& all, double sigma, std::uint64_t samples) {
  std::mt19937_64 words(2);
  if (sigma > 0) {
    std::normal_distribution<double> normal(0, sigma);
    print_goals(fmt::format("log-normal, {}", sigma), 1e-6 * std::exp(sigma * sigma / 2), samples,
                [&] { return 1e-6 * std::exp(normal(words)); });
  } else {
    print_goals("these", sample_moments(all).mean, samples,
                [&] { return all[words() % all.size()]; });
  }
}

}  // namespace misalign::bench
