// The assignment of particles to ranks, with an invented science of sheets: whatever the workers,
// their order and what earlier runs left, populations become the same. And numbers, messages, what
// files keep.
#include "search/ranks/climb_dispatcher.hpp"

#include <gtest/gtest.h>

#include <random>

#include "search/draws/models.hpp"
#include "search/ranks/piece_messages.hpp"
#include "search/splitting/climber.hpp"
#include "search/splitting/origin.hpp"
#include "tests/search/splitting_campaigns.hpp"

namespace misalign::search {
namespace {

constexpr std::uint32_t kParticles = 300, kFirst = 5000, kStarts = 4;

// One of four reaches the next level, by its number and its sheet; a sheet is two bytes. At the
// last level one of five is met; and starts end at once.
PieceResult invented(const PieceOrder& order, std::uint32_t hi) {
  PieceResult result;
  result.population = order.population;
  result.level = order.level;
  result.lo = order.lo;
  result.hi = hi;
  result.tried = hi - order.lo;
  result.seconds = 1e-3 * (hi - order.lo);
  for (std::uint32_t k = order.lo; !order.starts.empty() && k < hi; ++k) {
    MetCandidate& end = result.met.emplace_back(1, k, order.starts[k - order.lo]);
    end.candidate.ascent.emplace().steps = static_cast<int>(end.candidate.shifts_mm(1, 0));
  }
  for (std::uint32_t k = order.lo; order.starts.empty() && k < hi; ++k) {
    std::uint8_t sheet[2] = {static_cast<std::uint8_t>(k), static_cast<std::uint8_t>(order.level)};
    if (!order.is_first) sheet[0] ^= order.here.sheets[k - order.lo][0];
    const std::size_t word = std::hash<std::string>()(std::to_string(order.population) + " " +
                                                      std::to_string(order.level) + " " +
                                                      std::to_string(256 * k + sheet[0]));
    if (order.next == kBeyondAll && word % 5 == 0) {
      const Eigen::Vector2d shift_mm(sheet[0], static_cast<double>(word % 1000));
      result.met.emplace_back(1, k, schema::Candidate{0, {}, shift_mm});
    }
    const int score = 100 * static_cast<int>(order.level) + static_cast<int>(word % 134);
    if (score < order.next) continue;
    result.survivors.push_back(k);
    result.there.sheets.add(sheet);
    result.there.scores.push_back(score);
  }
  return result;
}

std::string words_of(const std::vector<PopulationRecord>& records) {
  std::map<std::uint32_t, std::string> words;
  for (const PopulationRecord& record : records) {
    for (const schema::LevelCount& level : record.levels) {
      words[record.population] += " " + std::to_string(level.survivors) + "/" +
                                  std::to_string(level.particles) + " of " +
                                  std::to_string(level.ancestors);
    }
    for (const FoundCandidate& found : record.found) {
      words[record.population] += " from " + std::to_string(found.origin.particle) + " to " +
                                  std::to_string(found.candidate.ascent.value().steps);
    }
  }
  std::string all;
  for (const auto& [population, of_levels] : words) {
    all += std::to_string(population) + ":" + of_levels + "\n";
  }
  return all;
}

ClimbDispatcher dispatcher(int workers, const std::vector<int>& levels = {100, 200, 300}) {
  return {
      {kClimbSeed, levels, kParticles, kFirst, kStarts}, 300, Ledger({0, 7}, {{2, 3}}), workers};
}

struct Climb {
  std::vector<PopulationRecord> records;
  std::vector<PieceResult> results;  // of all pieces, as they came
};

// Workers take and hand in in random order, now and then a part; at most so many pieces.
void climb(ClimbDispatcher& all, int workers, unsigned seed, Climb& into,
           int most = std::numeric_limits<int>::max()) {
  std::mt19937 words(seed);
  std::map<int, PieceOrder> out;
  while (!all.complete() && most-- > 0) {
    const int worker = static_cast<int>(words() % static_cast<unsigned>(workers));
    if (!out.contains(worker)) {
      if (auto order = all.assign(worker)) out.emplace(worker, std::move(*order));
    } else {
      const PieceOrder& order = out.at(worker);
      const bool is_part = words() % 5 == 0;
      const std::uint32_t hi = is_part ? (order.lo + order.hi) / 2 : order.hi;
      into.results.push_back(invented(order, hi));
      all.finish(worker, into.results.back());
      out.erase(worker);
    }
    EXPECT_EQ(all.has_job(worker), out.contains(worker));
    for (PopulationRecord& record : all.take_done()) into.records.push_back(std::move(record));
  }
}

TEST(ClimbDispatcher, PopulationsAreTheSameWhoeverWorks) {
  Climb alone;
  ClimbDispatcher one = dispatcher(1);
  climb(one, 1, 1, alone);
  const std::string expected = words_of(alone.records);
  EXPECT_EQ(alone.records.size(), 6u);  // one of seven was done before
  EXPECT_NE(expected.find("/300"), std::string::npos);
  EXPECT_NE(expected.find(" from "), std::string::npos);
  EXPECT_EQ(one.populations_left(), 0u);
  for (const int workers : {2, 3, 16}) {
    Climb together;
    ClimbDispatcher many = dispatcher(workers);
    climb(many, workers, 5 + static_cast<unsigned>(workers), together);
    EXPECT_EQ(words_of(together.records), expected) << workers;
  }
}

// Stopped after any number of pieces; what was handed in is what the next run begins with.
TEST(ClimbDispatcher, GoesOnFromWhatWasDone) {
  Climb alone;
  ClimbDispatcher one = dispatcher(1);
  climb(one, 1, 1, alone);
  for (int pieces = 1; pieces < 120; pieces += 7) {
    Climb first;
    ClimbDispatcher stopped = dispatcher(3);
    climb(stopped, 3, static_cast<unsigned>(pieces), first, pieces);
    std::ranges::sort(first.results, {}, [](const PieceResult& result) {
      return std::tuple(result.population, result.level, result.lo);
    });
    Climb second;
    ClimbDispatcher next = dispatcher(2);
    for (const PieceResult& result : first.results) {
      EXPECT_EQ(next.restore(result), result.hi > result.lo);
    }
    for (PopulationRecord& record : next.take_done()) second.records.push_back(std::move(record));
    climb(next, 2, 3, second);
    EXPECT_EQ(words_of(second.records), words_of(alone.records)) << pieces;
  }
}

TEST(ClimbDispatcher, WhatIsOfNoUseIsNotRestored) {
  ClimbDispatcher all = dispatcher(1);
  PieceResult result = invented(*dispatcher(1).assign(0), 100);
  result.population = 2;  // in the ledger
  EXPECT_FALSE(all.restore(result));
  result.population = 9;  // beyond the goal
  EXPECT_FALSE(all.restore(result));
  result.population = 1;
  result.level = 1;  // whose first draws are not done
  EXPECT_FALSE(all.restore(result));
  result.level = 0;
  EXPECT_TRUE(all.restore(result));
  EXPECT_FALSE(all.restore(result)) << "twice";
  result.population = LevelFinder::kNumber;
  EXPECT_FALSE(all.restore(result)) << "the levels are known";
}

// Where the goal turns out to end before populations that are under way, nobody works on for these.
TEST(ClimbDispatcher, NothingIsOpenBeyondTheGoal) {
  ClimbDispatcher all = dispatcher(16);
  std::map<int, PieceOrder> out;
  for (int worker = 0; worker < 16; ++worker) {
    if (auto order = all.assign(worker)) out.emplace(worker, std::move(*order));
  }
  EXPECT_GT(out.rbegin()->second.population, 3u);
  all.cut(3);
  Climb rest;
  for (auto& [worker, order] : out) {
    const bool is_wanted = order.population < 3;
    all.finish(worker, invented(order, is_wanted ? order.hi : order.lo + 1));
  }
  climb(all, 16, 4, rest);
  EXPECT_TRUE(all.complete());
  EXPECT_FALSE(all.anything_open());
  EXPECT_FALSE(all.assign(0));
  for (const PieceResult& result : rest.results) EXPECT_LT(result.population, 3u);
}

// Those of one population go to all ranks, one start each.
TEST(ClimbDispatcher, AscentsAreSharedOut) {
  ClimbDispatcher all({kClimbSeed, {100, 200}, kParticles, kFirst, kStarts}, 200,
                      Ledger({0, 1}, {}), 3);
  std::optional<PieceOrder> order = all.assign(0);
  for (; order->starts.empty(); order = all.assign(0)) all.finish(0, invented(*order, order->hi));
  std::vector<std::uint32_t> particles = {order->lo};
  for (const int worker : {1, 2}) {
    const PieceOrder other = all.assign(worker).value();
    EXPECT_EQ(other.starts.size(), 1u);
    particles.push_back(other.lo);
  }
  EXPECT_EQ(particles, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(all.under_way(), "population 0, optimising its sheets");
  all.finish(0, invented(*order, order->lo));  // stopped on its way
  EXPECT_EQ(all.assign(0)->lo, 0u);
}

// A level finder comes first, for all; then its levels are news once.
TEST(ClimbDispatcher, PilotsComeFirst) {
  std::vector<int> scores;
  for (const int workers : {1, 4}) {
    ClimbDispatcher all = dispatcher(workers, {});
    Climb record;
    EXPECT_FALSE(all.take_news_of_levels());
    climb(all, workers, 2, record);
    EXPECT_TRUE(all.take_news_of_levels());
    EXPECT_FALSE(all.take_news_of_levels());
    EXPECT_EQ(record.results.front().population, LevelFinder::kNumber);
    EXPECT_EQ(record.records.size(), 6u);
    EXPECT_EQ(all.ladder().scores.back(), 300);
    if (scores.empty()) scores = all.ladder().scores;
    EXPECT_EQ(all.ladder().scores, scores);
  }
}

TEST(Ledger, TakesWhatIsNamedIfAllOfItIsOpen) {
  Ledger ledger({10, 100}, {{40, 50}});
  EXPECT_FALSE(ledger.take(DrawRange{30, 45}));
  EXPECT_FALSE(ledger.take(DrawRange{5, 15}));
  EXPECT_FALSE(ledger.take(DrawRange{20, 20}));
  EXPECT_TRUE(ledger.take(DrawRange{20, 30}));
  EXPECT_FALSE(ledger.take(DrawRange{29, 31}));
  EXPECT_EQ(ledger.open_draws(), 70u);
  EXPECT_EQ(*ledger.take(100), (DrawRange{10, 20}));
  EXPECT_EQ(*ledger.take(100), (DrawRange{30, 40}));
  ledger.finish({20, 30}, 30);
  EXPECT_TRUE(ledger.take(DrawRange{50, 100}));
  EXPECT_EQ(ledger.draws_given_out(), 70u);
}

// Numbers go up with (population, level, step, particle).
TEST(Origin, IsInTheNumber) {
  const schema::Splitting splitting{{}, 70, 3, 700};
  std::uint64_t last = 0;
  for (const Origin& origin : std::vector<Origin>{{0, 0, 0, 1},
                                                  {0, 0, 0, 699},
                                                  {0, 1, 1, 0},
                                                  {0, 1, 1, 69},
                                                  {0, 1, 2, 0},
                                                  {0, 1, 3, 69},
                                                  {0, 2, 1, 0},
                                                  {0, 256, 3, 69},
                                                  {1, 0, 0, 0},
                                                  {922337202, 256, 3, 69}}) {
    const std::uint64_t number = number_of(origin, splitting);
    EXPECT_GT(number, last);
    EXPECT_EQ(origin_of(number, splitting), origin);
    EXPECT_EQ(number / schema::kNumbersOfPopulation, origin.population);
    last = number;
  }
}

// A piece that meets candidates, there and back; and whatever a file may have in its place is
// either none or one that fits.
TEST(PieceMessages, KeptPiecesAreWholeOrNone) {
  const schema::Campaign campaign = climbed_miura(165);
  Climber climber(campaign, widest_set());
  const Ladder ladder{kClimbSeed, {160 * 1024, 165 * 1024}, 40, 300};
  Population population(ladder, 0);
  const PieceOrder order = *population.take(300);
  EXPECT_EQ(pack(unpack_order(pack(order))), pack(order));
  PieceWork work = climber.start(order);
  while (!work.finished()) work.run_next_block();
  const PieceResult result = work.take();
  ASSERT_FALSE(result.met.empty());
  const solver::Model model = scoring_model_of(campaign, 160);
  const auto kept = [&](const Bytes& bytes) {
    return unpack_kept({bytes.begin(), bytes.end()}, campaign, climber.moves().code(),
                       model.mechanism());
  };
  const Bytes bytes = pack(SentPiece{result, false});
  const auto whole = kept(bytes);
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->survivors, result.survivors);
  EXPECT_EQ(whole->there.sheets.bytes, result.there.sheets.bytes);
  EXPECT_EQ(whole->met.size(), result.met.size());
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 50) {
    EXPECT_FALSE(kept(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size))));
  }
  std::mt19937 words(kClimbSeed);
  for (int k = 0; k < 2000 / kFewer; ++k) {
    Bytes changed = bytes;
    for (int i = 0; i < 3; ++i) changed[words() % 200] = static_cast<char>(words());
    if (const auto piece = kept(changed)) {
      EXPECT_EQ(piece->survivors.size(), piece->there.count());
      EXPECT_LT(piece->lo, piece->hi);
    }
  }
}

}  // namespace
}  // namespace misalign::search
