// Studies without a value: each reason from a sheet that has it.
#include "solver/studies/study_result.hpp"

#include "solver/bending/preload.hpp"
#include "solver/contact/contact.hpp"
#include "solver/motion/pin_friction.hpp"
#include "solver/optimise/optimise.hpp"
#include "tests/solver/few_holes.hpp"
#include "tests/solver/own_sheet.hpp"

namespace misalign::solver {
namespace {

template <typename T>
void expect_reason(const StudyResult<T>& result, NoResult reason) {
  EXPECT_FALSE(result);
  EXPECT_EQ(result.fault(), nullptr);
  ASSERT_TRUE(result.reason());
  EXPECT_EQ(*result.reason(), reason);
}

OptimiseOptions by_all_vertices(const Sheet& sheet) {
  OptimiseOptions options;
  options.shifted = all_vertices(sheet.base().sheet);
  options.deploys_from_sample = 30;
  return options;
}

// Shifts of a third of a panel: no state near flat is found.
TEST(StudyResult, IsNoneWhereThePathIsLost) {
  const TestSheet sheet(4, 4);
  Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count());
  std::srand(3);  // Eigen's Random
  for (const int v : interior_vertices(sheet.base.sheet)) {
    shifts_mm.col(v) = 27 * Eigen::Vector2d::Random();
  }
  const OwnSheet lost(sheet.base, shifts_mm);
  ASSERT_EQ(lost.sheet.way(), nullptr);
  expect_reason(contact(lost.sheet, {0, {}}), NoResult::path_lost);
  expect_reason(static_release(lost.sheet), NoResult::path_lost);
  expect_reason(deploy(lost.sheet), NoResult::path_lost);
  expect_reason(study_pins(lost.sheet, {}, 0), NoResult::path_lost);
  expect_reason(bend_panels(lost.sheet, {}), NoResult::path_lost);
  expect_reason(optimise(lost.sheet, by_all_vertices(lost.sheet)), NoResult::path_lost);
}

// Stretching is stiffer than bending by (width / thickness)^2; where that is above some 1e13,
// rounding, 1e-16 of what stretches, hides what bends. Next to flat panels are taken 1e4 times as
// stiff.
TEST(StudyResult, IsNoneWherePanelsAreTooThin) {
  const TestSheet sheet(4, 4);
  const OwnSheet own(sheet.base, member_of(sheet.base, 4, true, 1));
  ReleaseOptions deploying;
  deploying.sheet.springs().preload.each_n = 1e-6;
  BentPanelsOptions options;
  options.method = BendMethod::linear;
  const auto with_thickness = [&](double mm) {
    deploying.sheet.plates.thickness_mm = mm;
    return bend_panels(own.sheet, deploying, options);
  };
  expect_reason(with_thickness(1e-8), NoResult::panels_not_stable);
  const StudyResult<BentPanels> thin = with_thickness(1e-3), usual = with_thickness(1);
  ASSERT_TRUE(thin);
  EXPECT_FALSE(thin.reason());
  expect_reason(study_preload(own.sheet, deploying, *thin), NoResult::panels_not_stable);
  EXPECT_TRUE(study_preload(own.sheet, deploying, *usual));
}

TEST(StudyResult, IsNoneForABetterSheetWithFewHoles) {
  const PerforatedSheet base = with_holes({0, 5, 10});
  const OwnSheet own(base, member_of(base, 2, true, 1));
  ASSERT_TRUE(own.model.is_overconstrained());
  expect_reason(optimise(own.sheet, by_all_vertices(own.sheet)), NoResult::overconstrained);
  EXPECT_TRUE(contact(own.sheet)) << "its own path is known";
  const StudyResult<ContactStudy> beyond = contact(own.sheet, {{}, 200.0});
  EXPECT_FALSE(beyond.reason());
  ASSERT_TRUE(beyond.fault());
  EXPECT_EQ(beyond.fault()->name, "from_deg");
  EXPECT_FALSE(contact(own.sheet, {{}, 200.0}).if_any());
}

}  // namespace
}  // namespace misalign::solver
