#include "search/draws/ledger.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace misalign::search {
namespace {

TEST(Ledger, OpenIsWhatIsWantedAndNotDone) {
  Ledger ledger({100, 200}, {{0, 50}, {90, 110}, {120, 130}, {190, 250}});
  EXPECT_EQ(ledger.open_draws(), 10u + 60u);
  EXPECT_EQ(ledger.take(1000), (DrawRange{110, 120}));
  EXPECT_EQ(ledger.take(25), (DrawRange{130, 155}));
  EXPECT_EQ(ledger.take(1000), (DrawRange{155, 190}));
  EXPECT_EQ(ledger.take(1), std::nullopt);
  EXPECT_FALSE(ledger.complete());
  ledger.finish({110, 120}, 120);
  ledger.finish({130, 155}, 140);  // cut short: 140 to 155 are open again
  ledger.finish({155, 190}, 155);  // nothing done
  EXPECT_EQ(ledger.take(1000), (DrawRange{140, 155}));
  EXPECT_EQ(ledger.take(1000), (DrawRange{155, 190}));
}

TEST(Ledger, CutForgetsWhatLiesBeyond) {
  Ledger ledger({0, 1000}, {{100, 200}});
  const auto taken = ledger.take(50);
  ledger.cut(30);
  EXPECT_EQ(ledger.open_draws(), 0u);
  ledger.finish(*taken, 10);
  EXPECT_EQ(ledger.open_draws(), 20u);  // 10 to 30, not to 50
  EXPECT_EQ(ledger.take(1000), (DrawRange{10, 30}));
  ledger.finish({10, 30}, 30);
  EXPECT_TRUE(ledger.complete());
}

// Who works on draws that nobody wants any more is not waited for.
TEST(Ledger, CompleteBelowTheEnd) {
  Ledger ledger({0, 1000}, {});
  const auto below = ledger.take(100), straddling = ledger.take(100), beyond = ledger.take(100);
  ledger.cut(150);
  ledger.finish(*below, 100);
  EXPECT_FALSE(ledger.complete());
  ledger.finish(*straddling, 200);
  EXPECT_TRUE(ledger.complete());
  EXPECT_EQ(ledger.draws_given_out(), 100u);
  ledger.finish(*beyond, 210);
  EXPECT_TRUE(ledger.complete());
  EXPECT_EQ(ledger.take(100), std::nullopt);
}

// Random workers that die, return early and finish in any order: every draw is done exactly once.
TEST(Ledger, EveryDrawOnceWhateverHappens) {
  const std::uint64_t seed = 5;
  std::mt19937_64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const std::uint64_t lo = random() % 50, hi = lo + 1 + random() % 500;
    std::vector<int> times(hi, 0);
    std::vector<DrawRange> done;
    for (std::uint64_t at = random() % 60; at < hi; at += 1 + random() % 90) {
      const std::uint64_t to = std::min(hi + 20, at + 1 + random() % 40);
      done.push_back({at, to});
      for (std::uint64_t d = at; d < std::min(hi, to); ++d) ++times[d];
      at = to;
    }
    Ledger ledger({lo, hi}, done);
    std::vector<DrawRange> out;
    while (!ledger.complete()) {
      if (const auto range = ledger.take(1 + random() % 30); range && random() % 3) {
        out.push_back(*range);
      } else if (range) {
        ledger.finish(*range, range->lo);
      }
      while (out.size() > 5 || (!out.empty() && ledger.open_draws() == 0)) {
        const std::size_t k = random() % out.size();
        const std::uint64_t to = out[k].lo + random() % (out[k].size() + 1);
        for (std::uint64_t d = out[k].lo; d < to; ++d) ++times[d];
        ledger.finish(out[k], to);
        out.erase(out.begin() + static_cast<std::ptrdiff_t>(k));
      }
    }
    for (std::uint64_t d = lo; d < hi; ++d) ASSERT_EQ(times[d], 1) << "seed " << seed;
  }
}

}  // namespace
}  // namespace misalign::search
