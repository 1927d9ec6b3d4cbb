#include "schema/pattern/wish.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "schema/files/user_error.hpp"
#include "tests/folder.hpp"

namespace misalign::schema {
namespace {

Wish wish_of(const std::string& free) {
  const Folder folder("wish");
  return read_wish(folder.file("wish.json", R"({"family": "miura", "rows": 4, "columns": 4,
    "design": {"from_deg": 120, "thickness_mm": 2}, "free": )" +
                                                free + "}"));
}

std::string refusal_of(const std::string& free) {
  try {
    wish_of(free);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

TEST(Wish, ReadsBoundsListsAndChoices) {
  const Wish wish = wish_of(R"({"amplitude_mm": [0.5, 4], "thickness_mm": {"of": [3, 1, 2, 2]},
    "preload_n": [0, 20], "plate.prestretch": [1, 1.2], "from_deg": [60, 140],
    "holes": ["checkerboard-odd", [[1, 1], [2, 2]]], "rim": true})");
  const Free& free = wish.free;
  EXPECT_EQ(free.amplitude_mm, (std::array{0.5, 4.0}));
  EXPECT_EQ(free.from_deg, (std::vector{140.0, 100.0, 60.0}));  // both bounds and their middle
  ASSERT_EQ(free.numbers.size(), 3u);
  for (const FreeNumber& number : free.numbers) {
    const bool is_list = number.row->number == &Design::thickness_mm;
    EXPECT_EQ(number.is_range, !is_list) << number.row->key;
    EXPECT_EQ(number.values.size(), is_list ? 3u : 2u);  // 3, 1, 2 and 2
    EXPECT_TRUE(std::ranges::is_sorted(number.values));
    EXPECT_EQ(number.row->block == "plate", number.row->key == "prestretch");
  }
  EXPECT_TRUE(free.rim);
  EXPECT_FALSE(free.hold_flat || free.one_a_hole);
  ASSERT_EQ(free.holes.size(), 2u);
  EXPECT_FALSE(wish.document.contains("free"));
  const Json chosen = wished_document(wish, {&free.holes[1], nullptr, 100});
  EXPECT_EQ(chosen["holes"], free.holes[1]);
  EXPECT_EQ(chosen["design"], (Json{{"from_deg", 100.0}, {"thickness_mm", 2}}));
  EXPECT_EQ(wished_document(wish, {}), wish.document);
  EXPECT_EQ(choices_of(free).size(), 6u);
  EXPECT_EQ(choices_of(free)[3].words(), ", holes [[1,1],[2,2]], for 140°");
}

TEST(Wish, AFillingTakesThePlaceOfSprings) {
  const Wish wish =
      wish_of(R"({"fill": [{"kind": "springs", "stiffness_n_per_mm": 3}, {"kind": "plate"}]})");
  const std::vector<WishChoice> choices = choices_of(wish.free);
  ASSERT_EQ(choices.size(), 2u);
  for (const WishChoice& choice : choices) {
    const Json design = wished_document(wish, choice)["design"];
    EXPECT_EQ(design["fill"], *choice.fill);
    EXPECT_EQ(design["thickness_mm"], 2);
  }
  EXPECT_EQ(choices[1].words(), ", \"plate\"");
  EXPECT_NE(choices[0].words(), choices[1].words());
}

TEST(Wish, AValueIsTheNearestThatIsAllowed) {
  const Free free = wish_of(R"({"thickness_mm": {"of": [1, 2, 4]}, "preload_n": [0.5, 20]})").free;
  const auto nearest = [&](std::optional<double> Design::*number, double value) {
    const auto at = std::ranges::find_if(
        free.numbers, [&](const auto& one) { return one.row->number == number; });
    return at->nearest(value);
  };
  // The middle of 2 and 4 by ratio is the root of 8.
  EXPECT_EQ(nearest(&Design::thickness_mm, std::sqrt(8) - 1e-6), 2);
  EXPECT_EQ(nearest(&Design::thickness_mm, std::sqrt(8) + 1e-6), 4);
  EXPECT_EQ(nearest(&Design::thickness_mm, 100), 4);
  EXPECT_EQ(nearest(&Design::preload_n, 0), 0.5);
  EXPECT_EQ(nearest(&Design::preload_n, 7), 7);
}

TEST(Wish, RefusesWhatCannotBeChosen) {
  const auto expect_words = [](const std::string& free, const std::string& words) {
    EXPECT_NE(refusal_of(free).find(words), std::string::npos) << free << "\n" << refusal_of(free);
  };
  expect_words(R"({"thickness_mm": [3, 1]})", "free.thickness_mm = [3,1]");
  expect_words(R"({"thickness_mm": [1, 2, 3]})", "neither two bounds nor a list");
  expect_words(R"({"thickness_mm": 2})", "neither two bounds nor a list");
  expect_words(R"({"thickness_mm": [0, 1e9]})", "leaves 0.001 to 100");
  expect_words(R"({"static_margin": [1, 2]})", "is a requirement");
  expect_words(R"({"holes": "any"})", "misalign perforations");
  expect_words(R"({"fill": {"kind": "plate"}})", "no list of choices");
  expect_words(R"({"holes": ["checkerboard-odd", "checkerboard-odd"]})", "twice");
  expect_words(R"({"rim": 1})", "free.rim = 1");
  expect_words(R"({"thicknes_mm": [1, 2]})", "free.thicknes_mm");
  expect_words(R"({"amplitude_mm": ["a", 2]})", "free.amplitude_mm");
  expect_words("[]", "free");
  EXPECT_EQ(refusal_of(R"({"thickness_mm": [2, 2]})"), "");
  EXPECT_EQ(wish_of(R"({"from_deg": [120, 120]})").free.from_deg, std::vector{120.0});
}

TEST(Wish, NeedsToBeFreeInSomething) {
  const Folder folder("wish");
  const std::string path =
      folder.file("base.json", R"({"family": "miura", "rows": 4, "columns": 4})");
  EXPECT_THROW(read_wish(path), UserError);
}

}  // namespace
}  // namespace misalign::schema
