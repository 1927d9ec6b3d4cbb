#include "schema/files/suggestion.hpp"

#include <gtest/gtest.h>

namespace misalign::schema {
namespace {

TEST(Suggestion, IsTheNearestWordOrNone) {
  const std::vector<std::string> verbs = {"search", "status", "fold", "query", "export", "replay"};
  for (const auto& [typed, meant] :
       std::vector<std::pair<std::string, std::string>>{{"serch", "search"},   // one left out
                                                        {"seacrh", "search"},  // two swapped
                                                        {"statuss", "status"},
                                                        {"stat", "status"},
                                                        {"Fold", "fold"},
                                                        {"qurey", "query"},
                                                        {"exprot", "export"},
                                                        {"frobnicate", ""},
                                                        {"x", ""},
                                                        {"fo", ""},
                                                        {"", ""},
                                                        {"go", ""}}) {
    EXPECT_EQ(nearest_word(typed, verbs), meant) << typed;
  }
  EXPECT_EQ(nearest_word("--draw", {"--help", "--draws", "--range"}), "--draws");
  EXPECT_EQ(nearest_word("--colour", {"--color", "--check"}), "--color");
  EXPECT_EQ(nearest_word("-v", {"-h", "--help"}), "");
  EXPECT_EQ(nearest_word("anything", {}), "");
}

// The nearer of two, whatever their order.
TEST(Suggestion, PrefersFewerLettersOff) {
  EXPECT_EQ(nearest_word("merje", {"verify", "merge", "marge"}), "merge");
  EXPECT_EQ(nearest_word("merje", {"marge", "merge"}), "merge");
}

// Names of several words: those that hold what was typed, or the nearest.
TEST(Suggestion, NamesHoldOrAreNear) {
  const std::vector<std::string> names = {"red oak", "white oak", "bog oak", "live oak", "PLA"};
  EXPECT_EQ(meant_names("Oak", names), "; did you mean red oak or white oak or bog oak?");
  EXPECT_EQ(meant_names("white oka", names), "; did you mean white oak?");
  EXPECT_EQ(meant_names("pla", names), "; did you mean PLA?");
  EXPECT_EQ(meant_names("la", names), "");
  EXPECT_EQ(meant_names("granite", names), "");
  EXPECT_EQ(meant_names("", names), "");
}

}  // namespace
}  // namespace misalign::schema
