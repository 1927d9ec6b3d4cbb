// Studies of a sheet that is used between an angle and flat: contact and springs up to there, by
// the sheet's own history at its samples.
#include "solver/studies/angle_of_use.hpp"

#include <gtest/gtest.h>

#include "solver/contact/contact.hpp"
#include "solver/motion/actuation.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

struct UsedTable1 : testing::Test {
  UsedTable1() : base(6, 6) {}

  OwnSheet own(double at_deg = 0) const {
    PathPlanOptions options;
    if (at_deg > 0) options.look_at_deg = {at_deg};
    return OwnSheet(
        base.base,
        base.shifted(golden("table1_odd.json")["displacements_mm"]) - base.base.sheet.vertices_mm,
        options);
  }

  TestSheet base;
};

TEST_F(UsedTable1, DIsTheLastAngle) {
  const OwnSheet table1 = own();
  EXPECT_FALSE(beyond_d(table1.sheet, 156));
  EXPECT_FALSE(beyond_d(table1.sheet, 0.5));
  const auto fault = beyond_d(table1.sheet, 156.01);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->name, "from_deg");
  EXPECT_EQ(*fault->value, "156.01");
  EXPECT_NE(fault->why.find("D = 156 deg"), std::string::npos) << fault->why;
  const OwnSheet unshifted(base.base, Eigen::Matrix2Xd::Zero(2, 49));
  ASSERT_EQ(unshifted.sheet.deploys_from_deg(), 0);
  EXPECT_NE(beyond_d(unshifted.sheet, 10)->why.find("does not deploy"), std::string::npos);
}

// Tapers are as steep as the largest fold angle on the way up to there, and no longer.
TEST_F(UsedTable1, PlatesFoldAsFarAsTheyAreUsed) {
  const OwnSheet table1 = own();
  const ContactStudy whole = *contact(table1.sheet);
  EXPECT_EQ(whole.used_from_deg, 156);
  ASSERT_FALSE(contact(table1.sheet, {{}, 157.0}));
  EXPECT_EQ(contact(table1.sheet, {{}, 157.0}).fault()->name, "from_deg");
  double before_mm = std::numeric_limits<double>::infinity();
  for (const double from_deg : {30.0, 90.0, 140.0, 156.0}) {
    const ContactStudy used = *contact(table1.sheet, {{}, from_deg});
    EXPECT_EQ(used.used_from_deg, from_deg);
    EXPECT_EQ(used.reach_deg, from_deg) << "nothing meets before " << from_deg;
    ASSERT_TRUE(used.thickness);
    const FoldingHistory& history = table1.sheet.history();
    for (std::size_t i = 0; i < used.thickness->largest_rad.size(); ++i) {
      double largest_deg = 0;
      for (std::size_t row = 0; row < history.stations.size(); ++row) {
        if (history.stations[row].pilot_deg > from_deg + 1e-9) break;
        const double angle_deg =
            history.fold_angle_deg(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(i));
        largest_deg = std::max(largest_deg, std::abs(angle_deg));
      }
      // Samples are looked at every degree, the way four times a station: a maximum between them
      // lies within the angle that a crease turns in one such step.
      EXPECT_NEAR(used.thickness->largest_rad[i] / kRadPerDeg, largest_deg, 0.05) << i;
    }
    EXPECT_LE(used.thickness->thickness_mm, before_mm) << "folded farther, no plate gets thicker";
    before_mm = used.thickness->thickness_mm;
  }
  EXPECT_EQ(before_mm, whole.thickness->thickness_mm);
}

// Force and energy at an angle between two samples are those of the lengths there.
TEST_F(UsedTable1, SpringsAreJudgedUpToThere) {
  constexpr double kFrom_deg = 89.75;
  const OwnSheet table1 = own(kFrom_deg);
  const Actuators wires{Springs{2}, 0.01};
  const Actuation used = actuate(table1.sheet, wires, kFrom_deg),
                  whole = actuate(table1.sheet, wires);
  EXPECT_EQ(used.pilot_deg[static_cast<std::size_t>(used.from_row)], kFrom_deg);
  EXPECT_EQ(whole.pilot_deg[static_cast<std::size_t>(whole.from_row)], 156);
  Eigen::VectorXd lengths_mm, rates_mm;
  const FoldingWay& way = *table1.sheet.way();
  way.find_lengths(way.x_of(kFrom_deg), lengths_mm, rates_mm);
  double most = 0;
  for (Eigen::Index d = 0; d < lengths_mm.size(); ++d) {
    const double stretch_mm = lengths_mm(d) - way.flat_mm()(d);
    most = std::max(most, std::abs(stretch_mm) / way.flat_mm()(d));
    // The way is right to 1e-11 panel widths, and the spring has 2 N/mm.
    EXPECT_NEAR(used.force_n(used.from_row, d), 2 * stretch_mm, 1e-8) << d;
  }
  EXPECT_EQ(used.over_stroke.has_value(), most > 0.01);
  ASSERT_TRUE(whole.over_stroke) << "up to D some exceed 1 %";
  ASSERT_TRUE(used.weakest);
  EXPECT_LE(used.weakest->pilot_deg, kFrom_deg);
}

}  // namespace
}  // namespace misalign::solver
