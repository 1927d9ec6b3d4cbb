// Strips of joints that are tabs, beside the bores of both panels.
#include "schema/kit/strip_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "schema/files/user_error.hpp"
#include "tests/schema/kit/deploying_kit.hpp"

namespace misalign::schema {
namespace {

KitOptions tab_options() {
  KitOptions options;
  options.joints = {.kind = solver::JointKind::tab, .bore_mm = 1.5, .strip_mm = 3};
  options.joint_bore_mm = 1.5;
  return options;
}

const LineLayer& layer_of(const LineDrawing& drawing, const char* name) {
  return *std::ranges::find(drawing.layers, std::string(name), &LineLayer::name);
}

TEST(StripDrawing, StripsHaveTheBoresOfBothPanels) {
  const DeployingKit kit;
  const KitOptions options = tab_options();
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  const KitSheets sheets = kit_strip_sheets(kit.sheet, fittings, options, "tabs");
  ASSERT_EQ(sheets.beds.size(), 1u);
  const auto& cuts = layer_of(sheets.beds[0], "cut").paths;
  const auto& bores = layer_of(sheets.beds[0], "bore").circles;
  const std::size_t joints = kit.sheet.mechanism().balls.size();
  ASSERT_EQ(cuts.size(), joints);
  // Names and lines are engraved within their strips.
  for (const DrawnPath& line : layer_of(sheets.beds[0], "engrave").paths) {
    for (const Eigen::Vector2d& point : line.points_mm) {
      const bool is_within = std::ranges::any_of(cuts, [&](const DrawnPath& cut) {
        for (std::size_t k = 0; k < 4; ++k) {
          const Eigen::Vector2d along = cut.points_mm[(k + 1) % 4] - cut.points_mm[k],
                                off = point - cut.points_mm[k];
          if (cross(along, off) < -1e-9 * along.norm()) return false;
        }
        return true;
      });
      EXPECT_TRUE(is_within) << point.transpose();
    }
  }
  ASSERT_EQ(bores.size(), 2 * joints);
  std::vector<double> apart_mm, wanted_mm;
  for (const DrawnPath& cut : cuts) {
    ASSERT_EQ(cut.points_mm.size(), 4u);
    const Eigen::Vector2d middle_mm =
        0.25 * (cut.points_mm[0] + cut.points_mm[1] + cut.points_mm[2] + cut.points_mm[3]);
    std::vector<Eigen::Vector2d> own;
    for (const auto& bore : bores) {
      if ((bore.centre_mm - middle_mm).norm() < 10) own.push_back(bore.centre_mm);
    }
    ASSERT_EQ(own.size(), 2u);
    apart_mm.push_back((own[0] - own[1]).norm());
    // Material round both bores, on all sides.
    const double length_mm = std::max((cut.points_mm[1] - cut.points_mm[0]).norm(),
                                      (cut.points_mm[2] - cut.points_mm[1]).norm());
    EXPECT_NEAR(length_mm - apart_mm.back(), 1.5 + 2 * options.bore_edge_mm, 1e-9);
  }
  for (std::size_t k = 0; k < joints; ++k) {
    wanted_mm.push_back(
        (fittings.bores[2 * k].centre_mm - fittings.bores[2 * k + 1].centre_mm).norm());
  }
  std::ranges::sort(apart_mm);
  std::ranges::sort(wanted_mm);
  for (std::size_t k = 0; k < joints; ++k) EXPECT_NEAR(apart_mm[k], wanted_mm[k], 1e-9);
}

TEST(StripDrawing, FreeLengthsHaveRoomBetweenBores) {
  const DeployingKit kit;
  KitOptions options = tab_options();
  options.joints->strip_mm = 12;
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  EXPECT_THROW(kit_strip_sheets(kit.sheet, fittings, options, "tabs"), UserError);
  options.joints->kind = solver::JointKind::loop;
  EXPECT_TRUE(kit_strip_sheets(kit.sheet, fittings, options, "tabs").beds.empty());
}

}  // namespace
}  // namespace misalign::schema
