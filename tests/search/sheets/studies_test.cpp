// What people read where a study has no value: the reason that holds, and its cause.
#include "search/sheets/studies.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "search/sheets/better_sheet.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/study_json.hpp"
#include "search/sheets/study_texts.hpp"

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
    return contact_of(subject.sheet, {{}, from_deg, spring_bodies({}, diameter_mm, end_mm)});
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
