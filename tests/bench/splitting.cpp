// Measures splitting's yield and cost: rates by level, sheets found, how different they are, and
// what plain draws would need.
//   `splitting CAMPAIGN.json THRESHOLD_DEG POPULATIONS [PARTICLES SWEEPS FIRST_DRAWS [LEVEL_DEG
//   ...]]`
#include <fmt/format.h>

#include <cmath>
#include <set>

#include "schema/campaign/campaign_file.hpp"
#include "search/splitting/climber.hpp"
#include "tests/bench/cpu_seconds.hpp"

namespace misalign::search {
namespace {

void run(int argc, char** argv) {
  schema::Campaign campaign = schema::read_campaign_file(argv[1]);
  campaign.threshold_deg = std::atof(argv[2]);
  const auto populations = static_cast<std::uint32_t>(std::atoi(argv[3]));
  schema::Splitting& splitting = campaign.search.splitting.emplace();
  if (argc > 4) splitting.particles = static_cast<std::uint32_t>(std::atoi(argv[4]));
  if (argc > 5) splitting.sweeps = static_cast<std::uint32_t>(std::atoi(argv[5]));
  splitting.first_draws = 100 * splitting.particles;
  if (argc > 6) splitting.first_draws = static_cast<std::uint32_t>(std::atoi(argv[6]));
  for (int i = 7; i < argc; ++i) splitting.levels_deg.push_back(std::atof(argv[i]));
  Climber climber(campaign, solver::available_instruction_sets().back());
  double start_s = bench::cpu_seconds();
  const Ladder ladder = ladder_of(campaign, climber);
  fmt::print("{} levels, pilot {:.2f} CPU s\n", ladder.top(), bench::cpu_seconds() - start_s);
  start_s = bench::cpu_seconds();
  std::vector<schema::LevelCount> sums(ladder.top() + 1);
  std::vector<double> means(ladder.top() + 1), squares(means);
  std::set<std::vector<double>> sheets;
  std::uint64_t ancestors = 0;
  for (std::uint32_t r = 0; r < populations; ++r) {
    const PopulationRecord record = climbed(ladder, r, climber);
    for (const schema::LevelCount& level : record.levels) {
      schema::LevelCount& sum = sums[level.level];
      sum.particles += level.particles;
      sum.survivors += level.survivors;
      sum.tried += level.tried;
      sum.taken += level.taken;
      sum.undecided += level.undecided;
      sum.ancestors += level.ancestors;
      sum.seconds += level.seconds;
    }
    for (std::uint32_t k = 1; k <= ladder.top(); ++k) {
      means[k] += record.share(k);
      squares[k] += record.share(k) * record.share(k);
    }
    if (record.levels.size() > ladder.top() - 1)
      ancestors += record.levels[ladder.top() - 1].ancestors;
    for (const FoundCandidate& found : record.found) {
      const auto& s = found.candidate.shifts_mm;
      sheets.insert({s.data(), s.data() + s.size()});
    }
  }
  const double seconds = bench::cpu_seconds() - start_s, n = populations;
  for (std::uint32_t k = 0; k <= ladder.top(); ++k) {
    const schema::LevelCount& sum = sums[k];
    const double mean = k ? means[k] / n : 1;
    const double se = k ? std::sqrt((squares[k] / n - mean * mean) / (n - 1)) : 0;
    fmt::print(
        "level {:2} {:8.3f} deg  rate {:.3e} +- {:.1e}  next {:.3f}  taken {:.3f}  undecided {} "
        "ancestors {} {:.2f} s\n",
        k, ladder.score(k) * campaign.sample_deg / solver::kScoresPerSample, mean, se,
        static_cast<double>(sum.survivors) / std::max(1u, sum.particles),
        static_cast<double>(sum.taken) / static_cast<double>(std::max<std::uint64_t>(1, sum.tried)),
        sum.undecided, sum.ancestors, sum.seconds);
  }
  std::vector<const std::vector<double>*> some;
  for (const auto& sheet : sheets) some.push_back(&sheet);
  double distance = 0;
  std::size_t pairs = 0;
  const std::size_t step = std::max<std::size_t>(1, some.size() / 300);
  for (std::size_t i = 0; i < some.size(); i += step) {
    for (std::size_t j = i + step; j < some.size(); j += step, ++pairs) {
      for (std::size_t k = 0; k < some[i]->size(); ++k) distance += (*some[i])[k] != (*some[j])[k];
    }
  }
  fmt::print("{} sheets in {:.1f} CPU s: {:.2f}/s, {} ancestors, mean Hamming distance {:.2f}\n",
             sheets.size(), seconds, static_cast<double>(sheets.size()) / seconds, ancestors,
             distance / static_cast<double>(std::max<std::size_t>(pairs, 1)));
}

}  // namespace
}  // namespace misalign::search

int main(int argc, char** argv) { misalign::search::run(argc, argv); }
