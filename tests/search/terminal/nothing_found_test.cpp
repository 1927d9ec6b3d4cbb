#include "search/terminal/nothing_found.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/campaign/campaign_file.hpp"
#include "schema/campaign/climb_cost.hpp"
#include "search/draws/draw_evaluator.hpp"
#include "search/terminal/duration.hpp"

namespace misalign::search {
namespace {

using schema::Survival;
using schema::WeightedCount;

schema::CatalogueState nothing_in(std::uint64_t draws) {
  schema::CatalogueState state{};
  state.draws = state.rejected = state.draws_in_ledger = draws;
  state.threshold_deg = 175;
  state.draws_per_s = 20000;
  return state;
}

// 1,000 draws: 500 deploy from 40, 100 from 80, 10 from 120 and the last one from 131.
Survival made_up() {
  Survival survival(1, 180);
  survival.add(20, WeightedCount::of(500, 1024));
  survival.add(40, WeightedCount::of(400, 1024));
  survival.add(80, WeightedCount::of(90, 1024));
  survival.add(120, WeightedCount::of(9, 1024));
  survival.add(131, WeightedCount::of(1, 1024));
  return survival;
}

std::string all_of(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += sentence + "\n";
  return text;
}

TEST(NothingFound, SaysFromWhereDrawsSurviveAndHowRareTheOthersAre) {
  const std::string text = all_of(nothing_found(made_up(), nothing_in(1024000)));
  for (const char* part :
       {"in 1024000 draws", "from 175 deg is below 2.9e-06 (3/n, 95 %)", "more than 341333 draws",
        "half of the draws deploy from 40 deg", "one in ten from 80 deg",
        "one in a hundred from 120 deg", "the largest angle seen is 131 deg", "a guess",
        "(a guess, too)", "accept.deploys_from_deg = 1", "amplitude_mm",
        "search/manual/how-to/rare.md"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text;
  }
  EXPECT_EQ(text.find("one in a thousand from"), std::string::npos) << text;  // one row is too few
  for (const char* part : {"nan", "inf"}) EXPECT_EQ(text.find(part), std::string::npos) << text;
}

// One share in the middle of every step: 0.5 % of the first draws, then five times fewer a level.
TEST(NothingFound, SplittingCostsALevelForEveryFactorOfFive) {
  schema::Splitting keys;
  keys.particles = 1000;
  keys.sweeps = 10;
  keys.first_draws = 100000;
  for (const auto& [share, levels] :
       {std::pair{0.9, 1.0}, {0.005, 1.0}, {0.0011, 2.0}, {0.00021, 3.0}, {0.005 / 3124, 6.0}}) {
    const schema::ClimbCost cost = schema::climb_cost(keys, share);
    EXPECT_EQ(cost.levels, levels) << share;
    EXPECT_EQ(cost.moves, levels * 10000) << share;
    EXPECT_EQ(cost.draws, 100000 + schema::kDrawsOfMove * cost.moves) << share;
  }
}

// Splitting is advised where plain draws would take longer than a population, and only there.
TEST(NothingFound, AdvisesSplittingWhereItIsCheaper) {
  schema::CatalogueState state = nothing_in(1024000);
  const auto at = [&](double threshold_deg) {
    state.threshold_deg = threshold_deg;
    const schema::Json json = survival_json(made_up(), state);
    const std::string text = all_of(nothing_found(made_up(), state));
    EXPECT_EQ(text.find("splitting") != std::string::npos, json["splitting_population"].is_object())
        << text;
    if (json["splitting_population"].is_object()) {
      EXPECT_LT(json["splitting_population"]["worth_draws"],
                1 / json["guess_at_threshold"]["rate"].get<double>());
    }
    return json["splitting_population"].is_object();
  };
  EXPECT_FALSE(at(132)) << survival_json(made_up(), state);
  EXPECT_TRUE(at(180));
}

// A threshold below the stop that is asked for cannot be advised.
TEST(NothingFound, NamesTheStopThatIsTooStiff) {
  schema::CatalogueState state = nothing_in(1024000);
  for (const double stops_at_deg : {40.0, 170.0}) {
    state.stops_at_deg = stops_at_deg;
    const std::string text = all_of(nothing_found(made_up(), state));
    const bool is_beyond = stops_at_deg == 170;
    EXPECT_EQ(text.find("lower accept.stop_stiffness_mm2_per_rad2") != std::string::npos, is_beyond)
        << text;
    EXPECT_EQ(text.find("accept.deploys_from_deg = ") == std::string::npos, is_beyond) << text;
  }
}

TEST(NothingFound, IsSilentWhereSomethingWas) {
  schema::CatalogueState found = nothing_in(1000);
  found.accepted = 1;
  EXPECT_TRUE(nothing_found(made_up(), found).empty());
  EXPECT_TRUE(nothing_found(made_up(), nothing_in(0)).empty());
}

// Without a sample there is the rule of three all the same, and no guess.
TEST(NothingFound, WithoutASample) {
  const std::string text = all_of(nothing_found(Survival(1, 180), nothing_in(600)));
  EXPECT_NE(text.find("below 0.005 "), std::string::npos) << text;
  EXPECT_NE(text.find("more than 200 draws"), std::string::npos) << text;
  EXPECT_NE(text.find("not known yet"), std::string::npos) << text;
  EXPECT_EQ(text.find("guess"), std::string::npos) << text;
}

// The rule of three is none for a few draws: 0.95 of one draw, 1 - 0.05^(1/2) of two.
TEST(NothingFound, OfAFewDraws) {
  const std::string one = all_of(nothing_found(Survival(1, 180), nothing_in(1)));
  EXPECT_NE(one.find("in 1 draw: the share that deploys from 175 deg is below 0.95 (95 %)"),
            std::string::npos)
      << one;
  EXPECT_EQ(one.find("n/3"), std::string::npos) << one;
  const std::string two = all_of(nothing_found(Survival(1, 180), nothing_in(2)));
  EXPECT_NE(two.find("is below 0.78 (95 %)"), std::string::npos) << two;
}

// Ten undecided draws may all be accepted ones: up to 1.8 % of a thousand (Clopper and Pearson's
// table for 10 of 1,000: 0.48 % to 1.83 %).
TEST(NothingFound, UndecidedDrawsMayBeAcceptedOnes) {
  schema::CatalogueState state = nothing_in(1000);
  state.undecided = 10;
  const std::string text = all_of(nothing_found(Survival(1, 180), state));
  EXPECT_NE(text.find("is below 0.018 (95 %, if the 10 undecided"), std::string::npos) << text;
  EXPECT_NE(text.find("more than 54 draws"), std::string::npos) << text;
}

// What was counted bounds what is guessed: nothing in a million draws is no share of 1e-4.
TEST(NothingFound, GuessesNoMoreThanCountingLeavesSlow) {
  Survival shallow(1, 180);
  shallow.add(100, WeightedCount::of(80, 1024));
  shallow.add(150, WeightedCount::of(12, 1024));
  shallow.add(170, WeightedCount::of(4, 1024));
  shallow.add(174, WeightedCount::of(4, 1024));
  ASSERT_GT(shallow.guess(175)->rate, 3e-6);
  const schema::Json json = survival_json(shallow, nothing_in(1000000));
  EXPECT_LE(json["guess_at_threshold"]["rate"], 3e-6);
  EXPECT_LE(json["guess_at_threshold"]["rate_high"], 3e-6);
  EXPECT_EQ(json["deepest_deg"], 174);
}

TEST(NothingFound, AsJson) {
  const schema::Json json = survival_json(made_up(), nothing_in(1024000));
  EXPECT_EQ(json["sampled"], 1000);
  EXPECT_EQ(json["deepest_deg"], 131);
  ASSERT_EQ(json["shares"].size(), 3u) << json;
  for (const schema::Json& share : json["shares"]) {
    EXPECT_LT(share["share_low"], share["share"]);
    EXPECT_GT(share["share_high"], share["share"]);
  }
  EXPECT_EQ(json["shares"][0]["deploys_from_deg"], 40);
  EXPECT_EQ(json["shares"][0]["share"], 0.5);
  EXPECT_GT(json["guess_at_threshold"]["rate"], 0);
  const schema::Json none = survival_json(Survival(1, 180), nothing_in(10));
  EXPECT_TRUE(none["deepest_deg"].is_null());
  EXPECT_TRUE(none["guess_at_threshold"].is_null());
  EXPECT_TRUE(none["one_in_a_thousand_deg"].is_null());
  // Where draws were accepted the rate is known, and nothing is guessed.
  schema::CatalogueState found = nothing_in(1000);
  found.accepted = 3;
  EXPECT_TRUE(survival_json(made_up(), found)["guess_at_threshold"].is_null());
}

// A real campaign: the share at an angle that a few in a thousand survive, guessed from eighths of
// the draws that hardly ever have one so deep, against the count over all of them.
TEST(NothingFound, GuessesOfARealCampaignSlow) {
  DrawEvaluator evaluator(
      schema::read_campaign({{"pattern", {{"family", "miura"}, {"rows", 6}, {"columns", 6}}},
                             {"accept", {{"deploys_from_deg", 180}}}},
                            "a test"));
  constexpr int kParts = 8;
  constexpr std::uint64_t kDraws = 300;
  std::vector<Survival> parts(kParts, Survival(1, 180));
  Survival all(1, 180);
  for (std::uint64_t k = 0; k < kParts; ++k) {
    for (const solver::Verdict& verdict : evaluator.judge({k * kDraws, (k + 1) * kDraws})) {
      parts[k].add(verdict.deploys_from_sample, WeightedCount::of(1, 1024));
      all.add(verdict.deploys_from_sample, WeightedCount::of(1, 1024));
    }
  }
  int deep = 180;
  while (all.from(deep).rows < 12) --deep;
  const double truth = schema::share(all.from(deep), all.all());
  double log_off = 0;
  for (const Survival& part : parts) {
    const auto guess = part.guess(deep);
    ASSERT_TRUE(guess);
    EXPECT_LT(guess->low, 3 * truth);
    EXPECT_GT(guess->high, truth / 3);
    log_off += std::log(guess->rate / truth) / kParts;
  }
  EXPECT_LT(std::abs(log_off), std::log(4)) << std::exp(log_off) << " at " << deep;
}

TEST(Duration, InWords) {
  EXPECT_EQ(duration(59.9), "59 s");
  EXPECT_EQ(duration(60), "1 min 0 s");
  EXPECT_EQ(duration(3 * 3600 + 120), "3 h 2 min");
  EXPECT_EQ(duration(49 * 3600), "2 d 1 h");
  EXPECT_EQ(duration(1e10), "317 years");
  EXPECT_EQ(duration(1e300), "ages");
  EXPECT_EQ(duration(std::nan("")), "ages");
}

}  // namespace
}  // namespace misalign::search
