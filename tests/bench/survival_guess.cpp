// Errors of guesses from the tail of a survival curve (results/survival.md): fault samples of some
// sizes, made as a campaign makes them, against the shares that a long campaign counted.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "schema/catalogue/catalogue_state.hpp"
#include "schema/catalogue/survival.hpp"
#include "search/draws/draw_evaluator.hpp"

namespace misalign::bench {
namespace {

constexpr std::uint64_t kAtOnce = 256;
constexpr int kDeeper_deg[] = {0, 5, 10, 12, 15};

// Draws that no run of the catalogue made: far behind its last.
std::vector<int> deploying_samples(search::DrawEvaluator& evaluator, std::uint64_t draws) {
  constexpr std::uint64_t kFirst = std::uint64_t{1} << 50;
  std::vector<int> samples;
  for (std::uint64_t lo = 0; lo < draws; lo += kAtOnce) {
    const std::uint64_t hi = std::min(lo + kAtOnce, draws);
    for (const solver::Verdict& verdict : evaluator.judge({kFirst + lo, kFirst + hi})) {
      samples.push_back(verdict.deploys_from_sample);
    }
  }
  return samples;
}

void compare(const schema::Campaign& campaign, const std::vector<int>& samples, std::size_t size,
             int sample, double truth) {
  std::vector<double> log_off;
  int held = 0;
  for (std::size_t lo = 0; lo + size <= samples.size(); lo += size) {
    schema::Survival survival(
        campaign.sample_deg, static_cast<int>(std::lround(campaign.end_deg / campaign.sample_deg)));
    for (std::size_t k = lo; k < lo + size; ++k) {
      survival.add(samples[k], schema::WeightedCount::of(1, 1024));
    }
    const auto guess = survival.guess(sample);
    if (!guess) continue;  // the tail begins deeper: the share was seen
    log_off.push_back(std::log(guess->rate / truth));
    held += guess->low <= truth && truth <= guess->high;
  }
  if (log_off.empty()) return;
  double mean = 0;
  for (const double off : log_off) mean += off / static_cast<double>(log_off.size());
  const auto [least, most] = std::minmax_element(log_off.begin(), log_off.end());
  std::printf("%zu,%g,%.3g,%zu,%.2f,%.2f,%.2f,%d\n", size, sample * campaign.sample_deg, truth,
              log_off.size(), std::exp(mean), std::exp(*least), std::exp(*most), held);
}

void study(const std::string& path, std::uint64_t draws) {
  const auto database = schema::open_for_reading(path);
  const schema::CatalogueState state = schema::read_state(*database);
  search::DrawEvaluator evaluator(schema::read_campaign_of(*database, path));
  const std::vector<int> samples = deploying_samples(evaluator, draws);
  std::puts("draws,from_deg,counted,pieces,guess_over_counted,least,most,intervals_that_hold_it");
  for (const std::size_t size : {250, 500, 1000, 2000}) {
    for (const int deeper_deg : kDeeper_deg) {
      const double deg = evaluator.campaign().threshold_deg + deeper_deg;
      const int sample = static_cast<int>(std::lround(deg / evaluator.campaign().sample_deg));
      const auto counted = static_cast<double>(schema::count_deploying_from(*database, sample));
      if (counted > 0) {
        compare(evaluator.campaign(), samples, size, sample,
                counted / static_cast<double>(state.draws));
      }
    }
  }
}

}  // namespace
}  // namespace misalign::bench

int main(int arguments, char** argument) {
  if (arguments != 3) {
    std::fputs("usage: survival_guess CATALOGUE.db DRAWS\n", stderr);
    return 2;
  }
  try {
    misalign::bench::study(argument[1], std::strtoull(argument[2], nullptr, 10));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
