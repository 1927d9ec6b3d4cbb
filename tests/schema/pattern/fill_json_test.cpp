// Fillings in designs: what is read is written again, names are those of the sheet, and every fault
// is found.
#include "schema/pattern/fill_json.hpp"

#include <gtest/gtest.h>

#include "schema/campaign/campaign_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {
namespace {

solver::PerforatedSheet sheet() {
  return read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}}}, "test")
      .pattern.base;
}

Json plate() {
  return Json::parse(R"({"kind": "plate", "shear_mpa": 0.4, "thickness_mm": 2.0, "prestretch": 1.1,
                         "rest_deg": 30.0,
                         "cut_outs": [{"hole": [1, 2], "of_flat": [0.9, 0.95]}]})");
}

std::vector<std::string> faults_of_design(const Json& design) {
  InputFaults faults;
  read_design(design, "design", faults);
  return faults.sentences();
}

// Returns the first fault of a filling of `sheet()`.
std::string fault_of_sheet(const Json& fill) {
  InputFaults faults;
  const auto read = read_fill_of(sheet(), fill, "accept.fill", faults);
  EXPECT_EQ(read.has_value(), faults.none());
  return faults.none() ? "" : faults.sentences().front();
}

std::string diagonal_label(int d) {
  const solver::Mechanism mechanism = solver::build_mechanism(sheet());
  const solver::Diagonal& its = mechanism.diagonals[static_cast<std::size_t>(d)];
  return solver::line_label(its.from, its.to);
}

TEST(FillJson, PlatesAreWrittenAsTheyAreRead) {
  InputFaults faults;
  const Json design = {{"fill", plate()}};
  const Design read = read_design(design, "design", faults);
  EXPECT_TRUE(faults.none());
  EXPECT_EQ(explicit_design_json(read), design);
  EXPECT_FALSE(design_json(read).contains("springs"));

  const solver::PerforatedSheet base = sheet();
  const auto plates = std::get<solver::RubberPlates>(read.fill(base));
  EXPECT_EQ(plates.shear_mpa, 0.4);
  EXPECT_EQ(plates.thickness_mm, 2);
  EXPECT_EQ(plates.prestretch, 1.1);
  EXPECT_EQ(plates.rest_deg, 30);
  // The hole of the diagonals in the place of its index.
  ASSERT_EQ(plates.cut_outs.size(), 1u);
  const auto facet =
      static_cast<std::size_t>(base.holes[static_cast<std::size_t>(plates.cut_outs.front().hole)]);
  EXPECT_EQ(base.sheet.places[facet], (std::array<int, 2>{1, 2}));
  EXPECT_EQ(fill_json(read.fill(base), base), plate());
  EXPECT_FALSE(read.thickness_mm) << "that of the panels";
}

TEST(FillJson, SpringsAreTheSameByBothKeys) {
  const Json springs = {{"stiffness_n_per_mm", 3.0}, {"rest_deg", 60.0}, {"pull_only", true}};
  Json fill = springs;
  fill["kind"] = "springs";
  InputFaults faults;
  const Design older = read_design({{"springs", springs}}, "design", faults),
               newer = read_design({{"fill", fill}}, "design", faults);
  EXPECT_TRUE(faults.none());
  EXPECT_EQ(design_json(older), design_json(newer));
  EXPECT_EQ(newer.springs().rest_deg, 60);
  EXPECT_TRUE(newer.springs().pull_only);
}

TEST(FillJson, NothingStaysNothing) {
  const Json design = {{"fill", {{"kind", "none"}}}};
  InputFaults faults;
  const Design read = read_design(design, "design", faults);
  EXPECT_EQ(explicit_design_json(read), design);
  EXPECT_TRUE(std::holds_alternative<solver::NoFill>(read.fill(sheet())));
  EXPECT_EQ(fill_json(read.fill(sheet()), sheet()), design["fill"]);
}

TEST(FillJson, FindsEveryFault) {
  Json wrong = plate();
  wrong["shear_mpa"] = -1;
  wrong["prestretch"] = "1.1";
  wrong["colour"] = "red";
  wrong["cut_outs"] = Json::parse(R"([{"hole": [1], "of_flat": [0.9, 0.9]}, {"hole": [1, 2]}])");
  const auto faults = faults_of_design({{"fill", wrong}});
  ASSERT_EQ(faults.size(), 5u);
  EXPECT_NE(faults[0].find("design.fill.shear_mpa = -1"), std::string::npos);
  EXPECT_NE(faults[2].find("design.fill.cut_outs[0].hole"), std::string::npos);
  EXPECT_NE(faults[3].find("design.fill.cut_outs[1].of_flat (is missing)"), std::string::npos);
  EXPECT_NE(faults[4].find("design.fill.colour"), std::string::npos);

  const auto both = faults_of_design({{"fill", plate()}, {"springs", Json::object()}});
  ASSERT_EQ(both.size(), 1u);
  EXPECT_NE(both.front().find("is given beside design.springs"), std::string::npos);
  EXPECT_EQ(faults_of_design({{"fill", Json::object()}}).size(), 1u);
  EXPECT_EQ(faults_of_design({{"fill", {{"kind", "foam"}}}}).size(), 1u);
}

TEST(FillJson, NamesWhatTheSheetHas) {
  EXPECT_EQ(fault_of_sheet(plate()), "");
  Json other = plate();
  other["cut_outs"][0]["hole"] = {0, 0};
  EXPECT_NE(fault_of_sheet(other).find("accept.fill.cut_outs [0,0] (is no hole"),
            std::string::npos);
  other = plate();
  other["cut_outs"].push_back(other["cut_outs"][0]);
  EXPECT_NE(fault_of_sheet(other).find("is named twice"), std::string::npos);

  const std::string label = diagonal_label(1);
  const auto dash = label.find('-');
  Json spring = {
      {"from", label.substr(dash + 1)}, {"to", label.substr(0, dash)}, {"stiffness_n_per_mm", 2}};
  EXPECT_EQ(fault_of_sheet({{"kind", "springs"}, {"single", {spring}}}), "");
  EXPECT_NE(fault_of_sheet({{"kind", "springs"}, {"single", {spring, spring}}}).find("named twice"),
            std::string::npos);
  const std::string reversed = label.substr(dash + 1) + "-" + label.substr(0, dash);
  EXPECT_NE(fault_of_sheet({{"kind", "springs"}, {"preloads_n", {{label, 1}, {reversed, 2}}}})
                .find("named twice"),
            std::string::npos);
  spring["from"] = "A1";
  EXPECT_NE(fault_of_sheet({{"kind", "springs"}, {"single", {spring}}}).find("is no diagonal"),
            std::string::npos);
}

// A limit would be part of a campaign's identity without changing a verdict.
TEST(FillJson, LimitsAreNoPartOfACriterion) {
  for (const char* key : {"stroke_limit", "largest_force_n", "diameter_mm"}) {
    EXPECT_NE(fault_of_sheet({{"kind", "springs"}, {key, 1}}).find(key), std::string::npos);
  }
  const auto springs = fill_json(solver::Springs{}, sheet());
  EXPECT_EQ(fault_of_sheet(springs), "");
  EXPECT_FALSE(springs.contains("stroke_limit"));
}

TEST(FillJson, OptionsGoBeforeFilesOfTheSameFilling) {
  InputFaults faults;
  const Design plates = read_design({{"fill", plate()}}, "design", faults);
  Design typed;
  typed.rest_deg = 45;
  typed.thickness_mm = 3;
  const Design both = typed.merged_over(plates);
  EXPECT_EQ(std::get<solver::RubberPlates>(both.fill(sheet())).rest_deg, 45);
  EXPECT_EQ(std::get<solver::RubberPlates>(both.fill(sheet())).thickness_mm, 2);
  typed.stiffness_n_per_mm = 20;
  try {
    typed.merged_over(plates);
    FAIL() << "plates with a rate";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_request);
    EXPECT_NE(std::string(error.what()).find("rubber plates"), std::string::npos);
  }
  // Each value of springs by itself, also those that are no numbers.
  for (const char* value :
       {R"({"preload_n": 1})", R"({"preloads_n": {"A9-A15": 2}})", R"({"pull_only": true})",
        R"({"on": "all"})", R"({"stroke_limit": 0.1})",
        R"({"single": [{"from": "A9", "to": "A15", "stiffness_n_per_mm": 1}]})"}) {
    const Design of_springs = read_design({{"springs", Json::parse(value)}}, "design", faults);
    EXPECT_THROW(of_springs.merged_over(plates), UserError) << value;
  }
  Design springs;
  springs.fill_kind = FillKind::springs;
  EXPECT_TRUE(springs.merged_over(plates).is_springs());
  EXPECT_FALSE(springs.merged_over(plates).rest_deg) << "that of the plates";
}

}  // namespace
}  // namespace misalign::schema
