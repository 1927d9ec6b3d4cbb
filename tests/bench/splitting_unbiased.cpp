// Tests that estimates of splitting are right on average, and their intervals as often right as
// they say: many small campaigns, each with a seed of its own, against plain draws; and what other
// intervals would have been (results/splitting/unbiased.md), or campaigns that stop once theirs are
// narrow (results/splitting/stopping.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/split_rate.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/climber.hpp"
#include "tests/bench/climbed_to_top.hpp"
#include "tests/bench/plain_draws.hpp"
#include "tests/bench/share_intervals.hpp"
#include "tests/bench/stopped_campaigns.hpp"

namespace misalign::search {
namespace {

struct StudyOptions {
  std::string campaign, shares;
  double threshold_deg = 170, sigma = 0;
  schema::Splitting splitting{.levels_deg = {}, .particles = 60, .sweeps = 3, .first_draws = 1000};
  std::uint64_t campaigns = 400, plain_draws = 1000000, plain_accepted = 0, samples = 0,
                stopped = 0;
  std::uint32_t populations = 20;
};

using Shares = std::vector<std::vector<double>>;  // of each campaign's populations

schema::Campaign campaign_of(const StudyOptions& options, std::uint64_t seed) {
  schema::Campaign campaign = schema::read_campaign_file(options.campaign);
  campaign.threshold_deg = options.threshold_deg;
  campaign.seed = seed;
  campaign.search.splitting = options.splitting;
  return campaign;
}

// One line a campaign, the shares of its populations, as they are made.
Shares climbed_shares(const StudyOptions& options, std::ostream& file) {
  Shares shares;
  for (std::uint64_t seed = 1; seed <= options.campaigns; ++seed) {
    const schema::Campaign campaign = campaign_of(options, seed);
    Climber climber(campaign, solver::available_instruction_sets().back());
    const Ladder ladder = ladder_of(campaign, climber);
    std::vector<double>& own = shares.emplace_back();
    for (std::uint32_t number = 0; number < options.populations; ++number) {
      own.push_back(bench::climbed_to_top(ladder, number, climber).share(ladder.top()));
      file << fmt::format("{}{}", number > 0 ? "," : "", own.back());
    }
    file << std::endl;
  }
  return shares;
}

Shares read_shares(std::istream& file) {
  Shares shares;
  for (std::string line; std::getline(file, line);) {
    std::istringstream values(line);
    std::vector<double>& own = shares.emplace_back();
    for (std::string value; std::getline(values, value, ',');) own.push_back(std::stod(value));
  }
  return shares;
}

// Of these sheets, which the campaign accepts: those that some level would have lost.
std::uint64_t count_lost(const std::vector<schema::Candidate>& accepted, const Ladder& ladder,
                         LevelScorers& scorers) {
  if (accepted.empty()) return 0;
  solver::ShiftBlock block{{}, static_cast<int>(accepted.size())};
  for (const schema::Candidate& candidate : accepted) {
    for (const int vertex : scorers.campaign().misalignment.vertices) {
      block.shifts_mm.push_back(candidate.shifts_mm(0, vertex));
      block.shifts_mm.push_back(candidate.shifts_mm(1, vertex));
    }
  }
  std::vector<char> is_lost(accepted.size(), false);
  for (const int level : ladder.scores) {
    const std::vector<int>& scores = scorers.from(level).score(block);
    for (std::size_t k = 0; k < scores.size(); ++k) is_lost[k] |= scores[k] < level;
  }
  return static_cast<std::uint64_t>(std::ranges::count(is_lost, true));
}

std::uint64_t count_accepted(const StudyOptions& options) {
  constexpr std::uint64_t kSeed = 0;
  const auto set = solver::available_instruction_sets().back();
  const schema::Campaign campaign = campaign_of(options, kSeed);
  DrawEvaluator evaluator(campaign, set);
  Climber climber(campaign, set);
  const Ladder ladder = ladder_of(campaign, climber);
  std::uint64_t lost = 0;
  const auto [accepted, undecided] =
      bench::count_plain_draws(evaluator, options.plain_draws, [&](const schema::UnitRecord& unit) {
        lost += count_lost(unit.candidates, ladder, climber.scorers());
      });
  fmt::print("{} plain draws: {} accepted, of which {} are below some level; {} undecided\n",
             options.plain_draws, accepted, lost, undecided);
  return accepted;
}

struct Moments {
  double mean, standard_error;
};
Moments moments(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

void compare(const Shares& shares, double plain, double plain_error) {
  std::vector<double> all;
  std::size_t reached = 0, below = 0, above = 0, converged = 0, missed = 0;
  double width = 0;
  for (const std::vector<double>& own : shares) {
    all.insert(all.end(), own.begin(), own.end());
    const schema::SplitRate rate = schema::split_rate(own);
    reached += rate.reached;
    if (!rate.interval) continue;
    below += rate.interval->high < plain;
    above += rate.interval->low > plain;
    width += *rate.relative_half_width() / static_cast<double>(shares.size());
    if (!has_converged(rate)) continue;
    ++converged;
    missed += rate.interval->high < plain || rate.interval->low > plain;
  }
  const Moments estimate = moments(all);
  const double error = std::hypot(estimate.standard_error, plain_error);
  fmt::print("plain {:.4e} +- {:.1e}, splitting {:.4e} +- {:.1e}: {:+.2f} standard errors\n", plain,
             plain_error, estimate.mean, estimate.standard_error, (estimate.mean - plain) / error);
  const auto campaigns = static_cast<double>(shares.size());
  fmt::print(
      "{} campaigns, {:.1f} % of the populations reach the top; intervals: {:.1f} % hold "
      "the plain rate, {} lie below it, {} above, relative half width {:.2f}\n",
      shares.size(), 100 * static_cast<double>(reached) / static_cast<double>(all.size()),
      100 * (1 - static_cast<double>(below + above) / campaigns), below, above, width);
  fmt::print("{} have converged, of which {} do not hold it\n", converged, missed);
}

void run(const StudyOptions& options) {
  std::ifstream made(options.shares);
  std::ofstream file;
  if (!made) file.open(options.shares);
  const Shares shares = made ? read_shares(made) : climbed_shares(options, file);
  if (options.samples > 0 || options.stopped > 0) {
    std::vector<double> all;
    for (const std::vector<double>& own : shares) all.insert(all.end(), own.begin(), own.end());
    if (options.samples > 0) bench::compare_intervals(all, options.populations, options.samples);
    if (options.stopped > 0) bench::compare_goals(all, options.sigma, options.stopped);
    return;
  }
  const auto draws = static_cast<double>(options.plain_draws);
  const auto accepted = static_cast<double>(options.plain_accepted > 0 ? options.plain_accepted
                                                                       : count_accepted(options));
  compare(shares, accepted / draws, std::sqrt(accepted) / draws);
}

}  // namespace
}  // namespace misalign::search

int main(int count, char** arguments) {
  misalign::search::StudyOptions options;
  CLI::App app("Estimates of many small splitting campaigns against the rate of plain draws");
  app.add_option("campaign", options.campaign, "campaign file")->required();
  app.add_option("--from", options.threshold_deg, "threshold, deg")->capture_default_str();
  app.add_option("--levels", options.splitting.levels_deg, "deg, the threshold last")->required();
  app.add_option("--particles", options.splitting.particles)->capture_default_str();
  app.add_option("--sweeps", options.splitting.sweeps)->capture_default_str();
  app.add_option("--first-draws", options.splitting.first_draws)->capture_default_str();
  app.add_option("--campaigns", options.campaigns)->capture_default_str();
  app.add_option("--populations", options.populations, "of each")->capture_default_str();
  app.add_option("--plain-draws", options.plain_draws)->capture_default_str();
  app.add_option("--plain-accepted", options.plain_accepted,
                 "known to be accepted of these; 0: they are made");
  app.add_option("--shares", options.shares, "CSV file: read if it is there, otherwise written")
      ->required();
  app.add_option("--samples", options.samples,
                 "compare intervals instead, of so many samples of --populations from all shares");
  app.add_option("--stopped", options.stopped,
                 "the same of so many campaigns that go on until a relative error is met");
  app.add_option("--sigma", options.sigma, "with --stopped: of log-normal shares instead");
  CLI11_PARSE(app, count, arguments);
  misalign::search::run(options);
}
