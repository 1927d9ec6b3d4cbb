// What people read where a study has no value: the reason that holds, and its cause.
#include "search/sheets/studies.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "search/sheets/better_sheet.hpp"
#include "search/sheets/card.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"
#include "solver/sheet/energy_history.hpp"

namespace misalign::search {
namespace {

using schema::Cause;
using schema::Json;
using schema::UserError;
using solver::NoResult;

constexpr const char* kLost = "its folding path is lost";

Subject subject_of(const Json& pattern, const schema::Design& design = {}) {
  return {sheet_of_pattern_document(pattern, "a test", {}, "it", schema::Perforations::of_one_path),
          design};
}

template <typename Study>
void expect_refused(const Study& study, Cause cause, const std::string& start) {
  try {
    study();
    ADD_FAILURE() << "not refused: " << start;
  } catch (const UserError& error) {
    const std::string sentence = error.what();
    EXPECT_TRUE(sentence.starts_with(start)) << sentence;
    EXPECT_EQ(error.cause(), cause) << sentence;
    EXPECT_EQ(sentence.find(kLost) == sentence.npos, start.find(kLost) == start.npos) << sentence;
  }
}

// Found by trying shifts of up to 25 mm.
TEST(Studies, SayThatAPathIsLost) {
  const Subject lost = subject_of({{"family", "miura"},
                                   {"rows", 4},
                                   {"columns", 4},
                                   {"displacements_mm",
                                    {{"A7", {14.7, 16.1}},
                                     {"A8", {-0.7, -11.9}},
                                     {"A9", {-25.0, 8.1}},
                                     {"A12", {-1.5, 13.0}},
                                     {"A13", {-6.3, 13.5}},
                                     {"A14", {-11.4, 15.1}},
                                     {"A17", {11.5, -4.3}},
                                     {"A18", {1.9, 9.1}},
                                     {"A19", {-15.4, 2.7}}}}});
  const auto start = std::string("it: ") + kLost;
  expect_refused([&] { contact_of(lost.sheet, {0, {}}); }, Cause::failure, start);
  expect_refused([&] { deployed(lost.sheet, {}); }, Cause::failure, start);
  expect_refused([&] { bent_sheet(lost.sheet, {}, {}); }, Cause::failure, start);
}

// Both springs of a hole cross at its middle when the sheet is flat.
TEST(Studies, SayWhichSpringsTouch) {
  const Subject subject =
      subject_of({{"family", "miura"},
                  {"rows", 4},
                  {"columns", 4},
                  {"displacements_mm", {{"A7", {0.4, 0.4}}, {"A13", {0.4, -0.4}}}}});
  const double from_deg = std::min(1.0, subject.sheet.deploys_from_deg());
  const auto judged = [&](std::optional<double> diameter_mm, std::optional<double> end_mm) {
    schema::Design design;
    design.from_deg = from_deg;
    design.diameter_mm = diameter_mm;
    return contact_of(subject.sheet, contact_options(design, {}, end_mm));
  };
  EXPECT_TRUE(study_json(subject, judged({}, {})).at("springs").is_null());
  const solver::ContactStudy study = judged(4, {});
  const Json json = study_json(subject, study).at("springs");
  EXPECT_EQ(json.at("end_mm"), 8);
  ASSERT_EQ(json.at("springs").at("touching").size(), subject.chosen.base.base.holes.size());
  for (const Json& met : json.at("springs").at("touching")) {
    EXPECT_EQ(met.at("springs").size(), 2);
    EXPECT_NEAR(met.at("clear_mm").get<double>(), -4, solver::kSpringTouch_mm);
  }
  const std::string first = json.at("springs").at("touching")[0].at("springs")[0];
  const std::string text = contact_text(subject.chosen.base, subject.sheet.panels(), study);
  EXPECT_NE(text.find("touch          springs " + first), text.npos) << text;
  expect_refused([&] { judged(4, 60); }, Cause::bad_request, "end_mm=60: leaves nothing");
  expect_refused([&] { judged({}, 6); }, Cause::bad_request, "end_mm=6: is of springs as bodies");
}

// Springs that cannot touch as there is one in each hole, and fillings that are no springs.
TEST(Studies, TakeSpringsAsBodiesFromTheDesign) {
  const Json four = {{"family", "miura"},
                     {"rows", 4},
                     {"columns", 4},
                     {"displacements_mm", {{"A7", {0.4, 0.4}}, {"A13", {0.4, -0.4}}}}};
  schema::Design design;
  design.from_deg = 1;
  EXPECT_FALSE(contact_options(design, {}, {}).springs);
  design.diameter_mm = 4;
  design.thickness_mm = 2;
  const Subject all = subject_of(four, design);
  EXPECT_EQ(contact_options(all.model.design(), {}, {}).springs->panel_mm, 2);
  design.springs_on = solver::SpringsOn::one_a_hole;
  const Subject one = subject_of(four, design);
  const auto touching = [](const Subject& subject) {
    return contact_of(subject.sheet, contact_options(subject.model.design(), {}, {}))
        .springs->springs.touching;
  };
  EXPECT_EQ(touching(all).size(), all.chosen.base.base.holes.size());
  EXPECT_TRUE(touching(one).empty());
  // Both springs of a hole keep off each other in two layers, and lie on one of the faces.
  const solver::SpringFaces faces = faces_of_springs(all.sheet, all.model.design(), {});
  ASSERT_EQ(faces.springs.size(), 2 * all.chosen.base.base.holes.size());
  const Json json =
      study_json(all, contact_of(all.sheet, contact_options(all.model.design(), {}, {})), faces);
  EXPECT_EQ(json.at("springs").at("faces").at("springs").size(), faces.springs.size());
  EXPECT_GE(json.at("springs").at("faces").at("least_clearance_mm"), 0);
  for (std::size_t d = 0; d < faces.springs.size(); d += 2) {
    EXPECT_GE(std::abs(faces.springs[d].height_mm - faces.springs[d + 1].height_mm), 4);
  }
  design.fill_kind = schema::FillKind::plate;
  EXPECT_FALSE(contact_options(design, {}, {}).springs);
  design.fill_kind = schema::FillKind::none;
  expect_refused([&] { faces_of_springs(all.sheet, design, {}); }, Cause::bad_request,
                 "offset_ends: is of springs, and this sheet's holes have none");
}

// Diagonals of one hole cross when it is flat: springs on both would touch.
TEST(Studies, MarkNoTwoSpringsOfOneHoleAsEnough) {
  const Subject table1(
      sheet_of_pattern_file(std::string(MISALIGN_SOURCE_DIR) + "/search/patterns/table1.json"), {});
  const solver::Actuation actuation = actuated(table1.sheet, table1.model.design());
  ASSERT_TRUE(actuation.few);
  std::set<int> holes;
  for (const int d : actuation.few->diagonals) {
    EXPECT_TRUE(holes.insert(d / 2).second) << "both diagonals of hole " << d / 2;
  }
}

// Samples are counted up to where the energy of equal springs turns.
TEST(Studies, JudgeAChosenSheetByItsEnergy) {
  const std::string table1 = MISALIGN_SOURCE_DIR "/search/patterns/table1.json";
  const auto energy = solver::CertifiedBy::energy;
  const Subject by_diagonals = choose_sheet(table1, {}),
                by_energy = choose_sheet(table1, {}, {}, energy);
  const solver::EnergyHistory found =
      solver::energy_history(by_diagonals.sheet, by_diagonals.sheet.history(), solver::Springs{});
  EXPECT_EQ(by_energy.sheet.verdict().deploys_from_sample, found.deploys_from_sample);
  EXPECT_TRUE(by_energy.chosen.sampling.energy_of);
  const auto card_line = [](const Subject& subject) {
    const schema::Card card = card_of(subject, {.trials = 2}).card;
    return std::ranges::find(card.lines, "deploys_from_deg", &schema::CardLine::key)->what;
  };
  EXPECT_EQ(card_line(by_diagonals), "Deployment angle D, every diagonal monotone");
  EXPECT_EQ(card_line(by_energy), "Deployment angle D, total energy falls");
  schema::Design one;
  one.springs_on = solver::SpringsOn::one_a_hole;
  expect_refused([&] { choose_sheet(table1, {}, one, energy); }, Cause::bad_request,
                 "criterion=energy: needs a filling that is relaxed flat");
}

TEST(Studies, RefuseEmptyHolesWhereEnergyIsNeeded) {
  schema::Design none;
  none.fill_kind = schema::FillKind::none;
  const Subject empty = choose_sheet(MISALIGN_SOURCE_DIR "/search/patterns/table1.json", {}, none);
  const std::string start = "table1: the filling of its holes stores no energy, so ";
  expect_refused([&] { card_of(empty, {}); }, Cause::bad_request, start + "it has no card");
  expect_refused(
      [&] { bent_sheet(empty.sheet, deploy_options(none, empty.sheet), empty.model.design()); },
      Cause::bad_request, start + "its panels are not bent");
}

TEST(Studies, SayThatPanelsAreTooThin) {
  schema::Design design;
  design.thickness_mm = 0.001;
  design.preload_n = 1e-4;
  const Subject thin =
      subject_of({{"family", "miura"},
                  {"rows", 4},
                  {"columns", 4},
                  {"displacements_mm", {{"A7", {0.4, 0.4}}, {"A13", {0.4, -0.4}}}}},
                 design);
  const solver::ReleaseOptions options = deploy_options(design, thin.sheet);
  expect_refused([&] { bent_sheet(thin.sheet, options, design); }, Cause::failure,
                 "it: the stiffness of its panels is not positive");
}

TEST(Studies, SayThatASheetIsOverconstrained) {
  const Subject few = subject_of(
      {{"family", "miura"}, {"rows", 6}, {"columns", 6}, {"holes", {{1, 2}, {3, 4}, {4, 1}}}});
  expect_refused([&] { optimised(few, {}); }, Cause::bad_request, "it: it is overconstrained");
}

// A build without a library cannot be had here: the sentence alone.
TEST(Studies, SayWhatThisBuildLacks) {
  const auto refuse = [](NoResult reason) {
    throw study_error(reason, "it", "it cannot be released");
  };
  expect_refused([&] { refuse(NoResult::not_in_this_build); }, Cause::failure,
                 "a deployment needs SUNDIALS");
  expect_refused([&] { refuse(NoResult::panels_not_stable); }, Cause::failure, "it: the stiffness");
}

}  // namespace
}  // namespace misalign::search
