// The design block: what is read is written again, options go before files, and pattern files and
// exports carry it.
#include <gtest/gtest.h>

#include <fstream>
#include <numbers>

#include "schema/campaign/campaign_file.hpp"
#include "schema/files/output_file.hpp"
#include "schema/pattern/design_json.hpp"
#include "solver/kinematics/mechanism.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "tests/folder.hpp"

namespace misalign::schema {
namespace {

Design read_alone(const Json& value) {
  InputFaults faults;
  const Design design = read_design(value, "design", faults);
  for (const std::string& sentence : faults.sentences()) ADD_FAILURE() << sentence;
  return design;
}

// Every key, none at its default.
Json full() {
  return Json::parse(R"({"from_deg": 140.0,
    "springs": {"stiffness_n_per_mm": 2.0, "stroke_limit": 0.08, "preload_n": 3.0,
                "preloads_n": {"A9-A15": 2.0}, "largest_force_n": 25.0, "rest_deg": 60.0,
                "diameter_mm": 5.0, "pull_only": true, "on": "one_a_hole",
                "single": [{"from": "A10", "to": "A16", "stiffness_n_per_mm": 12.0,
                            "free_mm": 110.0}]},
    "hinges": {"friction_n_mm_per_mm": 0.02, "stiffness_n_mm_per_mm": 0.3, "kind": "dash",
               "pin_friction_mm": 0.075,
               "film": {"thickness_mm": 0.05, "e_gpa": 2.5, "length_mm": 1.0, "loss": 0.01}},
    "joints": {"kind": "tab", "bore_mm": 1.5, "wire_mm": 1.2, "edge_mm": 3.0, "clearance_mm": 0.3,
               "strip_mm": 4.0},
    "wanted": {"static_margin": 2.0, "margin_to_deg": 5.0, "energy_margin": 3.0, "yield": 0.9,
               "landing_deg_per_s": 100.0},
    "thickness_mm": 1.5,
    "material": {"name": "birch", "e_gpa": 12.0, "poisson": 0.3, "density_g_per_cm3": 0.68,
                 "strength_mpa": 40.0},
    "miscut_mm": 0.05, "play_mm": 0.01, "hold": [0, 3], "hold_flat": true,
    "gravity": [0.0, 0.0, -1.0]})");
}

TEST(Design, IsWrittenAsItIsRead) {
  EXPECT_EQ(design_json(read_alone(full())), full());
  EXPECT_EQ(explicit_design_json(read_alone(full())), full());
  EXPECT_EQ(explicit_design_json(read_alone(Json::object())), Json::object());
  EXPECT_EQ(read_alone(design_json({})).from_deg, std::nullopt);
  // Each key alone is said, and nothing else is.
  const Json flat = full().flatten();
  for (const auto& [at, value] : flat.items()) {
    const auto is_of = [&](const char* block) { return at.starts_with(block); };
    if (is_of("/material") || is_of("/hold") || is_of("/gravity") || is_of("/hinges/film") ||
        is_of("/springs/single")) {
      continue;
    }
    const Json one = Json({{at, value}}).unflatten();
    EXPECT_EQ(explicit_design_json(read_alone(one)), one);
  }
}

// A name goes into comments of decks, where a line feed would begin a keyword.
TEST(Design, NamesAreOfOneLineAndPrintable) {
  for (const char* name : {"steel\n*INCLUDE, INPUT=stolen.txt", "a\rb", "\x1b[2J", "\u202etxt",
                           "\u2028x", "\x7f", "\xc2\x9b"}) {
    Json block = full();
    block["material"]["name"] = name;
    InputFaults faults;
    read_design(block, "design", faults);
    ASSERT_EQ(faults.count(), 1u) << name;
    EXPECT_NE(faults.sentences().front().find("design.material.name"), std::string::npos);
  }
  Json block = full();
  block["material"]["name"] = "\u6298\u308a\u7d19, 0.1 mm";
  EXPECT_EQ(read_alone(block).material->name, "\u6298\u308a\u7d19, 0.1 mm");
}

// Diagonals A9-A15 and so forth, and a hole in row 1, column 2 of a sheet of 4 x 4.
TEST(Design, NamesWhatTheSheetHas) {
  const auto said = [](const Json& design) -> std::string {
    const Folder folder("design");
    const Json campaign = {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}},
                           {"accept", {{"deploys_from_deg", 150}}},
                           {"design", design}};
    try {
      read_campaign_file(folder.file("campaign.json", campaign.dump()));
    } catch (const UserError& error) {
      EXPECT_EQ(error.cause(), Cause::bad_input);
      return error.what();
    }
    return "";
  };
  const solver::PerforatedSheet base =
      read_campaign({{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}}}, "test")
          .pattern.base;
  ASSERT_FALSE(base.holes.empty());
  const auto& hole = base.sheet.places[static_cast<std::size_t>(base.holes.front())];
  EXPECT_EQ(said({{"hold", {0, 0}}}), "");
  EXPECT_NE(said({{"hold", {hole[0], hole[1]}}}).find("is no panel"), std::string::npos);
  EXPECT_NE(said({{"hold", {0, 4}}}).find("is no panel"), std::string::npos);
  // Corners of the sheet are of no hole.
  EXPECT_NE(said({{"springs", {{"preloads_n", {{"A1-A2", 2}}}}}}).find("is no diagonal"),
            std::string::npos);
  const solver::Diagonal diagonal = solver::build_mechanism(base).diagonals.front();
  const std::string label = solver::line_label(diagonal.from, diagonal.to);
  EXPECT_EQ(said({{"springs", {{"preloads_n", {{label, 2}}}}}}), "");
}

TEST(Design, SaysWhatStudiesTake) {
  const Design design = read_alone(full());
  EXPECT_EQ(design.springs().stiffness_n_per_mm, 2);
  EXPECT_EQ(*design.stroke_limit, 0.08);
  EXPECT_EQ(design.plates().thickness_mm, 1.5);
  EXPECT_EQ(design.plates().density_g_per_cm3, 0.68);
  EXPECT_EQ(design.springs().preload.each_n, 3);
  const solver::Diagonal named{0, 1, 3, 14, 8}, other{0, 2, 0, 8, 15};
  EXPECT_EQ(design.springs().preload.forces_n({other, named}), Eigen::Vector2d(3, 2));
  EXPECT_EQ(design.friction_n_mm_per_mm, 0.02);
  EXPECT_EQ(design.hinge_elastic_n_mm_per_mm(), 0.3);
  EXPECT_EQ(Design().springs().stiffness_n_per_mm, 50) << "the paper's";
  EXPECT_EQ(Design().plates().density_g_per_cm3, 2.7);
}

// A strip of 1 mm, 0.05 mm thick, 2.5 GPa: E I / L = 2500 * 0.05^3 / 12 N mm per mm and rad.
TEST(Design, TakesHingesOfTheFilm) {
  Json block = full();
  block["hinges"].erase("friction_n_mm_per_mm");
  block["hinges"].erase("stiffness_n_mm_per_mm");
  const Design design = read_alone(block);
  const double c = 2500 * 1.25e-4 / 12;
  EXPECT_NEAR(design.hinge_elastic_n_mm_per_mm(), c, 1e-15);
  // From 140 degrees to flat it takes pi / 4 loss c angle^2; dry friction takes it times the angle.
  const double angle = 140 * std::numbers::pi / 180;
  EXPECT_NEAR(design.film->friction_n_mm_per_mm(140) * angle,
              std::numbers::pi / 4 * 0.01 * c * angle * angle, 1e-15);
  EXPECT_EQ(Design().hinge_elastic_n_mm_per_mm(), 0);
}

TEST(Design, OptionsGoBeforeFiles) {
  const Design file = read_alone(full());
  EXPECT_EQ(design_json(Design().merged_over(file)), full());
  Design typed;
  typed.from_deg = 90;
  typed.stroke_limit = 0.01;
  typed.hinge_kind = CreaseCut::cut;
  const Json both = design_json(typed.merged_over(file));
  Json wanted = full();
  wanted["from_deg"] = 90.0;
  wanted["springs"]["stroke_limit"] = 0.01;
  wanted["hinges"]["kind"] = "cut";
  EXPECT_EQ(both, wanted);
  // A preload of all goes before the file's of one.
  typed.preload_n = 0;
  EXPECT_FALSE(typed.merged_over(file).springs().preload.is_any());
}

// Older campaigns say "actuators"; of two the newer name holds.
TEST(Design, HasTheSpringsOfOlderFiles) {
  const auto campaign = [](const Json& more) {
    Json json = {{"pattern", {{"family", "miura"}, {"rows", 4}, {"columns", 4}}}};
    json.update(more);
    return read_campaign(json, "a test");
  };
  const Campaign older = campaign({{"actuators", {{"stiffness_n_per_mm", 3}}}});
  EXPECT_EQ(older.design.springs().stiffness_n_per_mm, 3);
  EXPECT_EQ(identity(older), identity(campaign(Json::object())));
  const Campaign both = campaign({{"actuators", {{"stiffness_n_per_mm", 3}, {"stroke_limit", 0.5}}},
                                  {"design", {{"springs", {{"stiffness_n_per_mm", 4}}}}}});
  EXPECT_EQ(both.design.springs().stiffness_n_per_mm, 4);
  EXPECT_EQ(*both.design.stroke_limit, 0.5);
  const Campaign again = read_campaign(stored_configuration(both), "what a catalogue keeps");
  EXPECT_EQ(design_json(again.design), design_json(both.design));
  EXPECT_FALSE(stored_configuration(campaign(Json::object())).contains("design"));
}

TEST(Design, IsBesideThePatternOfAFile) {
  const Folder folder("design");
  const auto read_file = [&](const Json& document) {
    const std::string file = folder.file("p.json");
    write_text_file(file, document.dump());
    return read_sampled_pattern_file(file);
  };
  const Json pattern = {{"family", "miura"}, {"rows", 4}, {"columns", 4}};
  Json bare = pattern;
  bare["design"] = full();
  for (const Json& document :
       {bare, Json{{"pattern", pattern}, {"design", full()}, {"sampling", {{"sample_deg", 1}}}}}) {
    const PatternFile file = read_file(document);
    EXPECT_EQ(design_json(file.design), full());
    EXPECT_EQ(pattern_json(file.pattern, file.pattern.shifts_mm),
              pattern_json(read_file(pattern).pattern, file.pattern.shifts_mm));
  }
  bare["design"]["springs"]["stiffness_n_per_mm"] = -1;
  bare["rows"] = 5;
  try {
    read_file(bare);
    FAIL() << "a spring that pushes back";
  } catch (const UserError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("design.springs.stiffness_n_per_mm"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace misalign::schema
