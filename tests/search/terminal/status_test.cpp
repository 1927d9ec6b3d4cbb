#include <gtest/gtest.h>

#include <sstream>

#include "search/terminal/status_text.hpp"

namespace misalign::search {
namespace {

schema::CatalogueState state(std::uint64_t draws, std::uint64_t accepted, std::uint64_t missing) {
  schema::CatalogueState state{};
  state.identity = "0123456789abcdef";
  state.name = "small";
  state.seed = 1;
  state.goal.draws = draws + missing;
  state.goal_end = draws + missing;
  state.draws = state.draws_in_ledger = draws;
  state.accepted = accepted;
  state.rejected = draws - accepted;
  if (missing > 0) state.gaps = {{draws, draws + missing}};
  state.digest = "d";
  state.threshold_deg = 165;
  // Three rows of one weight, and one that stands for as many draws as two of them.
  state.faults = {{"not_monotone", schema::WeightedCount::of(3, 1024)},
                  {"fold_limit", schema::WeightedCount::of(1, 2048)}};
  return state;
}

// The words of the line that begins with `name`; empty if there is none.
std::vector<std::string> line(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) {
    std::istringstream words(one);
    std::vector<std::string> found;
    for (std::string word; words >> word;) found.push_back(word);
    if (!found.empty() && found[0] == name) return found;
  }
  return {};
}

using Words = std::vector<std::string>;

TEST(StatusText, IsATable) {
  const std::string text = status_text(state(200, 50, 10), {}, Paint(false));
  EXPECT_NE(text.find("small (01234567): work remains\n"), std::string::npos) << text;
  EXPECT_EQ(line(text, "done"), (Words{"done", "200"}));
  const Words accepted = line(text, "accepted");
  ASSERT_EQ(accepted.size(), 12u) << text;  // accepted from 165 deg 50 25 % LOW % to HIGH %
  EXPECT_EQ((Words{accepted.begin(), accepted.begin() + 4}),
            (Words{"accepted", "from", "165", "deg"}));
  EXPECT_EQ(accepted[4], "50");
  EXPECT_EQ(accepted[5], "25");
  EXPECT_LT(std::stod(accepted[7]), 25);
  EXPECT_GT(std::stod(accepted[10]), 25);
  EXPECT_EQ(line(text, "rejected"), (Words{"rejected", "150", "75", "%"}));
  const Words missing = line(text, "missing");
  ASSERT_GT(missing.size(), 2u) << text;
  EXPECT_EQ((Words{missing.begin(), missing.begin() + 2}), (Words{"missing", "10"}));
  EXPECT_NE(text.find("of the last run's goal"), std::string::npos) << text;  // of what, then
  EXPECT_EQ(line(status_text(state(200, 50, 0), {}, Paint(false)), "missing"),
            (Words{"missing", "0"}));
  Words fault = line(text, "not_monotone");  // 3 of 4 rows, 3 of 5 parts of the draws
  ASSERT_EQ(fault.size(), 9u) << text;
  EXPECT_EQ((Words{fault.begin(), fault.begin() + 4}), (Words{"not_monotone", "3", "60", "%"}));
  const schema::Json json = status_json(state(200, 50, 10));
  EXPECT_EQ(json["threshold_deg"], 165);
  EXPECT_EQ(json["fault_sample"]["not_monotone"]["sampled"], 3);
  EXPECT_DOUBLE_EQ(json["fault_sample"]["not_monotone"]["share"], 0.6);
  EXPECT_LT(json["fault_sample"]["not_monotone"]["share_low"], 0.6);
  EXPECT_GT(json["fault_sample"]["not_monotone"]["share_high"], 0.6);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  const auto column_after = [&](const std::string& part) {
    const std::size_t at = text.find(part);
    return at + part.size() - text.rfind('\n', at);
  };
  EXPECT_EQ(column_after(" 200"), column_after(" 150"));  // numbers end in one column
}

TEST(StatusText, CompleteOrEndlessOrAtAHigherThreshold) {
  EXPECT_NE(status_text(state(200, 50, 0), {}, Paint(false)).find(": complete\n"),
            std::string::npos);
  EXPECT_NE(status_text(state(200, 50, 0), {}, Paint(true)).find("\x1b["), std::string::npos);
  const std::string at =
      status_text(state(200, 50, 0), schema::DeployingFrom{172, 7}, Paint(false));
  EXPECT_EQ(line(at, "from")[3], "7") << at;
  schema::CatalogueState endless = state(200, 50, 10);
  endless.goal_end = schema::kEndOfDraws;
  endless.goal.draws = {};
  const std::string text = status_text(endless, {}, Paint(false));
  EXPECT_NE(text.find("without end"), std::string::npos) << text;
  EXPECT_TRUE(line(text, "missing").empty()) << text;
  // Nothing done at all: no share of nothing.
  const std::string none = status_text(state(0, 0, 10), {}, Paint(false));
  EXPECT_EQ(none.find("nan"), std::string::npos) << none;
}

TEST(NextStep, FollowsFromTheState) {
  EXPECT_EQ(next_step(state(200, 50, 10), "a.db", ""),
            "misalign search CAMPAIGN.json --catalogue a.db --draws 210 resumes");
  schema::CatalogueState beyond = state(200, 0, 0);
  beyond.draws_in_ledger = 5000;
  EXPECT_NE(next_step(beyond, "a.db", "").find("has more draws"), std::string::npos);
  EXPECT_EQ(line(status_text(beyond, {}, Paint(false)), "beyond")[2], "4800");
  schema::CatalogueState part = state(200, 50, 10);
  part.goal.range = {1000, 900000};
  part.goal.relative_error = 0.05;
  part.seed = 7;
  EXPECT_EQ(next_step(part, "a.db", "c.json"),
            "misalign search c.json --catalogue a.db --draws 210 --relative-error 0.05 --range "
            "1000:900000 --seed 7 resumes");
  EXPECT_EQ(next_step(state(200, 50, 10), "a.db", "my campaign.json"),
            "misalign search 'my campaign.json' --catalogue a.db --draws 210 resumes");
  EXPECT_NE(next_step(state(200, 50, 0), "it's.db", "").find("misalign query 'it'\\''s.db' best"),
            std::string::npos);
  // No shell and no program takes a file for an option.
  EXPECT_EQ(next_step(state(200, 50, 10), "-x.db", "-c.json"),
            "misalign search ./-c.json --catalogue ./-x.db --draws 210 resumes");
  EXPECT_EQ(next_step(state(200, 50, 0), "- x.db", "").find("misalign query './- x.db' best"), 0u);
  const std::string nothing = next_step(state(200, 0, 0), "a.db", "");
  EXPECT_NE(nothing.find("misalign report a.db"), std::string::npos) << nothing;
}

// Names from a file may be of any length, and as many as one likes (catalogue_fuzz, seed 9, input
// 32).
TEST(StatusText, NoFaultsNameFloodsIt) {
  schema::CatalogueState flooded = state(200, 200, 10);
  flooded.faults = {{std::string(100000, 'x'), schema::WeightedCount::of(1, 1024)}};
  EXPECT_LT(status_text(flooded, {}, Paint(false)).size(), 3000u);
  for (int k = 0; k < 10000; ++k) {
    flooded.faults["fault" + std::to_string(k)] = schema::WeightedCount::of(1, 1024);
  }
  EXPECT_LT(status_text(flooded, {}, Paint(false)).size(), 3000u);
}

}  // namespace
}  // namespace misalign::search
