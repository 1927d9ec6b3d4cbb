#include "search/designs/number_choice.hpp"

#include <gtest/gtest.h>

#include "search/sheets/studies.hpp"

namespace misalign::search {
namespace {

// A constructed 4 x 4 sheet with the design's numbers free.
struct FreeSheet {
  static schema::Json file(const char* design) {
    schema::Json file = {{"family", "miura"}, {"rows", 4}, {"columns", 4}};
    schema::InputFaults faults;
    const schema::Pattern base = schema::read_pattern(file, "", schema::Displacements::allowed, {},
                                                      faults, schema::Perforations::any);
    solver::ConstructOptions construct;
    construct.amplitude_mm = 2;
    construct.at_deg = 90;
    const auto study = constructed(base, "the sheet", true, construct);
    schema::Json made = schema::pattern_json(base, study.shifts_mm);
    made["design"] = schema::Json::parse(design);
    return made;
  }

  FreeSheet(const char* design, schema::Free what)
      : subject(sheet_of_pattern_document(file(design), "the sheet", {}, "the sheet",
                                          schema::Perforations::of_one_path),
                {}),
        on(card_sheet(subject)),
        free(std::move(what)) {}

  double score(const schema::Design& design) const {
    const CardSheet sheet{on.chosen, on.sheet, design, on.used_deg};
    return score_of(card_of(sheet, {.trials = 1, .advice = Advice::none}).card.lines).value;
  }

  Subject subject;
  CardSheet on;
  schema::Free free;
};

schema::FreeNumber number(std::string_view key, std::vector<double> values, bool is_range = true) {
  for (const schema::DesignNumber& row : schema::design_numbers()) {
    if (row.key == key && row.block != "plate") return {&row, std::move(values), is_range};
  }
  ADD_FAILURE() << key;
  return {};
}

constexpr char kSticky[] = R"({"from_deg": 90, "thickness_mm": 1, "hold_flat": true,
  "material": {"name": "plywood", "e_gpa": 8, "strength_mpa": 40},
  "springs": {"on": "one_a_hole", "stiffness_n_per_mm": 5},
  "hinges": {"friction_n_mm_per_mm": 0.0002}})";

TEST(NumberChoice, IsAsGoodAsTheBestOfAGrid) {
  const FreeSheet sheet(kSticky,
                        {{number("thickness_mm", {0.5, 3}), number("stiffness_n_per_mm", {0.5, 20}),
                          number("preload_n", {0, 8})}});
  const NumberChoice choice = choose_numbers(sheet.on, sheet.free, 60);
  EXPECT_NEAR(sheet.score(choice.design), choice.score.value, 1e-9);
  double best = -10;
  for (const double thickness_mm : {1.0, 3.0}) {
    for (const double rate : {2.0, 20.0}) {
      for (const double preload_n : {0.0, 1.0, 4.0}) {
        schema::Design design = sheet.on.design;
        design.thickness_mm = thickness_mm;
        design.stiffness_n_per_mm = rate;
        design.preload_n = preload_n;
        best = std::max(best, sheet.score(design));
      }
    }
  }
  EXPECT_GT(best, sheet.score(sheet.on.design));
  EXPECT_GE(choice.score.value, best - 0.05);  // steps of a tenth
}

TEST(NumberChoice, KeepsToListsAndSwitches) {
  schema::Free free{{number("thickness_mm", {0.5, 1.5, 2.5}, false), number("preload_n", {0, 2})}};
  free.one_a_hole = true;
  constexpr char kTouching[] = R"({"from_deg": 90, "thickness_mm": 1, "hold_flat": true,
    "springs": {"stiffness_n_per_mm": 2}, "hinges": {"friction_n_mm_per_mm": 0.002}})";
  const FreeSheet sheet(kTouching, free);
  const NumberChoice choice = choose_numbers(sheet.on, sheet.free, 30);
  const double thickness_mm = *choice.design.thickness_mm;
  EXPECT_TRUE(thickness_mm == 0.5 || thickness_mm == 1.5 || thickness_mm == 2.5) << thickness_mm;
  EXPECT_EQ(choice.design.springs_on, solver::SpringsOn::one_a_hole);  // else they touch
  EXPECT_EQ(choice.design.stiffness_n_per_mm, 2);                      // not free
  EXPECT_NE(chosen_words(choice.design, sheet.free).find("one_a_hole"), std::string::npos);
}

TEST(NumberChoice, MakesNoMoreCardsThanAllowed) {
  const FreeSheet sheet(kSticky, {{number("preload_n", {0, 8})}});
  const NumberChoice one = choose_numbers(sheet.on, sheet.free, 1),
                     more = choose_numbers(sheet.on, sheet.free, 8);
  EXPECT_GE(more.score.value, one.score.value);
  EXPECT_EQ(one.cards, 1);
  EXPECT_LE(more.cards, 8);
  EXPECT_GT(more.cards, 1);
}

}  // namespace
}  // namespace misalign::search
