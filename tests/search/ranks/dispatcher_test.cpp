#include "search/ranks/dispatcher.hpp"

#include <gtest/gtest.h>

#include <random>

namespace misalign::search {
namespace {

TEST(UnitDraws, ByTimeByShareAndNeverNothing) {
  EXPECT_EQ(unit_draws(100, 5, 1000000, 2), 500u);  // five seconds' worth
  EXPECT_EQ(unit_draws(100, 5, 1000, 4), 125u);     // an eighth of what is left
  EXPECT_EQ(unit_draws(0, 5, 1000000, 2), 32u);     // speed not known yet
  EXPECT_EQ(unit_draws(1e12, 5, ~0ULL >> 1, 1), 5000000000000u);
  EXPECT_EQ(unit_draws(1e-9, 5, 1000000, 2), 8u);
  EXPECT_EQ(unit_draws(1000, 5, 100, 4), 250u);  // a quarter of a second, however little is left
  EXPECT_EQ(unit_draws(1000, 50, 100, 4), 2500u);
  EXPECT_EQ(unit_seconds(8), 5);
  EXPECT_EQ(unit_seconds(10000), 50);  // 200 units a second
}

// Workers of different speeds that are cut short now and then: every draw once, in units of about
// the time they are to take, and never two ranges for one worker.
TEST(Dispatcher, EveryDrawOnceInUnitsByTime) {
  const unsigned seed = 8;
  std::mt19937 random(seed);
  for (int round = 0; round < 50; ++round) {
    const int workers = 1 + static_cast<int>(random() % 9);
    const std::uint64_t end = 20000 + random() % 20000;
    std::vector<int> times(end, 0);
    Dispatcher dispatcher(Ledger({0, end}, {}), workers, {{}, 2});
    std::vector<double> speed;
    for (int w = 0; w < workers; ++w) speed.push_back(20.0 + static_cast<double>(random() % 400));
    for (int w = 0; w < workers; ++w) dispatcher.assign(w);
    while (!dispatcher.complete()) {
      const int w = static_cast<int>(random() % static_cast<unsigned>(workers));
      const auto range = dispatcher.assigned(w);
      if (range) {
        const std::uint64_t to = random() % 20 ? range->hi : range->lo + random() % range->size();
        for (std::uint64_t d = range->lo; d < to; ++d) ++times[d];
        const double seconds = static_cast<double>(to - range->lo) / speed[w];
        EXPECT_LE(seconds, 2.001);
        dispatcher.finish(w, to, seconds);
      }
      EXPECT_FALSE(dispatcher.assigned(w));
      dispatcher.assign(w);
    }
    for (std::uint64_t d = 0; d < end; ++d) ASSERT_EQ(times[d], 1) << "seed " << seed;
    EXPECT_EQ(dispatcher.draws_left(), 0u);
  }
}

TEST(Dispatcher, UnitsOfAGivenSize) {
  Dispatcher dispatcher(Ledger({0, 100}, {{30, 40}}), 2, {40, 0});
  EXPECT_EQ(dispatcher.assign(0), (DrawRange{0, 30}));
  EXPECT_EQ(dispatcher.assign(1), (DrawRange{40, 80}));
  dispatcher.cut(60);
  EXPECT_FALSE(dispatcher.anything_open());
  EXPECT_EQ(dispatcher.draws_left(), 70u);
}

}  // namespace
}  // namespace misalign::search
