// Splitting as a whole: populations whatever their pieces, pilots, scores against plain draws.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "schema/catalogue/metric_table.hpp"
#include "search/draws/draw.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/splitting/climber.hpp"
#include "search/splitting/level_finder.hpp"
#include "tests/search/splitting_campaigns.hpp"

namespace misalign::search {
namespace {

// ---- Copies ----

// Each survivor has particles / survivors copies on average: the extra one is by chance, so often
// that five standard errors are allowed.
TEST(Splitting, SurvivorsHaveAsManyCopiesOnAverage) {
  constexpr std::uint32_t kPopulations = 4000;
  for (const auto& [survivors, particles] :
       {std::pair(1u, 10u), {3u, 10u}, {7u, 60u}, {10u, 10u}, {40u, 10u}, {64u, 1000u}}) {
    std::vector<double> sums(survivors, 0);
    for (std::uint32_t population = 0; population < kPopulations; ++population) {
      const auto copies = copies_of_survivors(kClimbSeed, population, 2, survivors, particles);
      ASSERT_EQ(copies.size(), particles);
      ASSERT_TRUE(std::ranges::is_sorted(copies));
      std::vector<std::uint32_t> own(survivors, 0);
      for (const std::uint32_t k : copies) ++own.at(k);
      for (std::uint32_t k = 0; k < survivors; ++k) {
        ASSERT_EQ(own[k] - particles / survivors, own[k] > particles / survivors ? 1u : 0u);
        sums[k] += own[k];
      }
    }
    const double expected = static_cast<double>(particles) / survivors;
    const double part = expected - std::floor(expected);
    const double error = std::sqrt(part * (1 - part) / kPopulations);
    for (const double sum : sums) {
      EXPECT_NEAR(sum / kPopulations, expected, 5 * error + 1e-12) << survivors << " " << particles;
    }
  }
}

// ---- Pieces ----

void add_number(std::string& words, const auto& number) { words += fmt::format(" {}", number); }
template <class Number>
void add_number(std::string& words, const std::optional<Number>& number) {
  words += number ? fmt::format(" {}", *number) : " none";
}

// All of a record, every bit, but seconds and candidates' draws: these are places in the blocks
// that were measured.
std::string words_of(const PopulationRecord& record) {
  std::string words = fmt::format("{}\n", record.population);
  for (const schema::LevelCount& level : record.levels) {
    words += fmt::format("{} {} {} {} {} {} {}\n", level.level, level.particles, level.survivors,
                         level.ancestors, level.tried, level.taken, level.undecided);
  }
  for (const auto& [origin, candidate] : record.found) {
    words +=
        fmt::format("{} {} {} {}", origin.population, origin.level, origin.step, origin.particle);
    for (const double shift : candidate.shifts_mm.reshaped()) add_number(words, shift);
    schema::each_metric(candidate.metrics, [&](const schema::MetricEntry&, const auto& value) {
      add_number(words, value);
    });
    for (const double elongation : candidate.metrics.elongation) add_number(words, elongation);
    words += "\n";
  }
  return words;
}

// An order that is out, and how much of it is done before the rest is given back.
struct Out {
  PieceOrder order;
  int steps;
};

// Pieces of random sizes, several out at once, done in random order, some of them in part.
template <class Climb>
void climb_in_pieces(Climb& climb, Climber& climber, unsigned seed) {
  std::mt19937 words(seed);
  std::vector<Out> out;
  while (!climb.is_done()) {
    while (out.size() < 4) {
      auto order = climb.take(1 + static_cast<std::uint32_t>(words() % 1900));
      if (!order) break;
      const bool in_part = words() % 3 == 0;
      out.push_back({std::move(*order), in_part ? static_cast<int>(words() % 5) : kBeyondAll});
    }
    ASSERT_FALSE(out.empty());
    std::swap(out[words() % out.size()], out.back());
    Out next = std::move(out.back());
    out.pop_back();
    const std::uint32_t end = next.order.hi;
    PieceWork work = climber.start(std::move(next.order));
    for (int step = 0; step < next.steps && !work.finished(); ++step) work.run_next_block();
    climb.add(end, work.take());
  }
}

TEST(Splitting, PiecesDoNotMatter) {
  const schema::Campaign campaign = climbed_miura(170);
  const int last = last_level(campaign);
  const Ladder ladder{
      kClimbSeed, {last - 15 * solver::kScoresPerSample + 300, last}, 500 / kFewer, 1500 / kFewer};
  Climber climber(campaign, widest_set());
  const PopulationRecord whole = climbed(ladder, 5, climber);
  ASSERT_EQ(whole.levels.size(), 3u);
  EXPECT_GT(whole.levels[0].survivors, 0u);
  EXPECT_GT(whole.found.size(), 20u / kFewer);
  for (unsigned seed = 1; seed <= (kFewer > 1 ? 1 : 2); ++seed) {
    Climber other(campaign, widest_set());
    Population population(ladder, 5);
    climb_in_pieces(population, other, seed);
    const PopulationRecord record = population.record();
    EXPECT_EQ(words_of(record), words_of(whole)) << seed;
  }
}

TEST(Splitting, FoundSheetsAreFoundOnceWhereTheyWereFirst) {
  const schema::Campaign campaign = climbed_miura(165);
  const int last = last_level(campaign);
  Climber climber(campaign, widest_set());
  const Ladder ladder{
      kClimbSeed, {last - 5 * solver::kScoresPerSample, last}, 100 / kFewer, 300 / kFewer};
  const PopulationRecord record = climbed(ladder, 0, climber);
  std::set<std::vector<double>> sheets;
  for (std::size_t k = 0; k < record.found.size(); ++k) {
    const schema::Candidate& candidate = record.found[k].candidate;
    const auto& s = candidate.shifts_mm;
    EXPECT_TRUE(sheets.insert({s.data(), s.data() + s.size()}).second);
    EXPECT_GE(candidate.metrics.deploys_from_sample, campaign.threshold_sample());
    EXPECT_TRUE(k == 0 || record.found[k - 1].origin < record.found[k].origin);
  }
  EXPECT_GT(sheets.size(), 20u / kFewer);
}

// The share is the product of what survived, and 0 from where it died.
TEST(Splitting, SharesAreProducts) {
  PopulationRecord record{0, {{0, 200, 50, 1, 0, 0, 0, 0, 0}, {1, 40, 10, 1, 0, 0, 0, 0, 0}}, {}};
  EXPECT_EQ(record.share(0), 1);
  EXPECT_EQ(record.share(1), 0.25);
  EXPECT_EQ(record.share(2), 0.0625);
  record.levels[1].survivors = 0;
  EXPECT_EQ(record.share(2), 0);
  EXPECT_EQ(record.share(3), 0);
}

TEST(Splitting, EveryInstructionSetGivesTheSameSlow) {
  const schema::Campaign campaign = climbed_miura(170);
  const int last = last_level(campaign);
  const Ladder ladder{kClimbSeed,
                      {last - 20 * solver::kScoresPerSample, last - 3000, last},
                      kFewer > 1 ? 40 : 120,
                      kFewer > 1 ? 150 : 400};
  std::string first;
  for (const solver::InstructionSet set : solver::available_instruction_sets()) {
    Climber climber(campaign, set);
    const PopulationRecord record = climbed(ladder, 1, climber);
    EXPECT_EQ(record.levels.size(), 4u);
    if (first.empty()) first = words_of(record);
    EXPECT_EQ(words_of(record), first) << solver::instruction_set_name(set);
  }
}

// ---- Pilots ----

Ladder piloted(std::uint64_t seed, unsigned pieces) {
  const schema::Campaign campaign = climbed_miura(175, seed);
  Climber climber(campaign, widest_set());
  LevelFinder level_finder(seed, 100, 600, last_level(campaign));
  climb_in_pieces(level_finder, climber, pieces);
  EXPECT_TRUE(level_finder.is_whole());
  return level_finder.ladder();
}

TEST(Splitting, PilotsAreFunctionsOfTheSeedSlow) {
  schema::Campaign campaign = climbed_miura(175);
  campaign.search.splitting->particles = 100;
  campaign.search.splitting->first_draws = 600;
  Climber climber(campaign, widest_set());
  const Ladder ladder = ladder_of(campaign, climber);
  EXPECT_EQ(ladder.scores.back(), last_level(campaign));
  EXPECT_GT(ladder.top(), 1u);
  EXPECT_TRUE(std::ranges::is_sorted(ladder.scores, std::less_equal()));
  EXPECT_EQ(ladder.particles, 100u);
  EXPECT_EQ(ladder.first_draws, 600u);
  EXPECT_EQ(piloted(kClimbSeed, 1).scores, ladder.scores);
  EXPECT_EQ(piloted(kClimbSeed, 2).scores, ladder.scores);
  EXPECT_NE(piloted(kClimbSeed + 1, 1).scores, ladder.scores);
}

// Levels that are named need no level finder.
TEST(Splitting, NamedLevelsAreTaken) {
  schema::Campaign campaign = climbed_miura(170);
  campaign.search.splitting->levels_deg = {150, 162.5, 170};
  Climber climber(campaign, widest_set());
  const Ladder ladder = ladder_of(campaign, climber);
  EXPECT_EQ(ladder.scores, (std::vector<int>{150 * 1024, 162 * 1024 + 512, 170 * 1024}));
  EXPECT_EQ(ladder.seed, kClimbSeed);
}

// ---- Scores against plain draws ----

// Who is accepted lies above every level, and whoever lies above a level has one score from all
// judges up to it: levels are nested. The long form is in results/splitting/unbiased.md.
TEST(Splitting, AcceptedDrawsAreAboveEveryLevelSlow) {
  const schema::Campaign campaign = climbed_miura(170);
  DrawEvaluator plain(campaign);
  LevelScorers scorers(campaign, widest_set());
  const int draws = kFewer > 1 ? 250 : 4000, last = last_level(campaign);
  constexpr std::uint64_t kAtOnce = 250;
  int accepted = 0;
  for (std::uint64_t lo = 0; lo < static_cast<std::uint64_t>(draws); lo += kAtOnce) {
    const std::vector<solver::Verdict> verdicts = plain.judge({lo, lo + kAtOnce});
    solver::ShiftBlock block{{}, static_cast<int>(kAtOnce)};
    for (std::uint64_t draw = lo; draw < lo + kAtOnce; ++draw) {
      std::vector<double> shifts_mm(2 * campaign.misalignment.vertices.size());
      draw_shifts(campaign.misalignment, kClimbSeed, draw, shifts_mm.data());
      block.shifts_mm.insert(block.shifts_mm.end(), shifts_mm.begin(), shifts_mm.end());
    }
    std::vector<int> lower;
    for (const int level : {150 * 1024, 160 * 1024 + 379, 165 * 1024, last}) {
      const std::vector<int>& scores = scorers.from(level).score(block);
      for (std::size_t k = 0; k < kAtOnce; ++k) {
        const bool is_accepted = campaign.accepts(verdicts[k]), is_above = scores[k] >= level;
        EXPECT_TRUE(is_above || !is_accepted) << "draw " << lo + k;
        EXPECT_TRUE(level < last || is_above == is_accepted) << "draw " << lo + k;
        if (lower.empty()) continue;
        EXPECT_EQ(is_above, lower[k] >= level) << "draw " << lo + k;
        EXPECT_TRUE(!is_above || scores[k] == lower[k]) << "draw " << lo + k;
      }
      lower = scores;
    }
    for (const solver::Verdict& verdict : verdicts) accepted += campaign.accepts(verdict);
  }
  EXPECT_GT(accepted, draws / 100);
}

}  // namespace
}  // namespace misalign::search
