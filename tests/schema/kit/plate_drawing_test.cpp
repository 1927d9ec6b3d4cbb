// Rubber plates of a kit: the cut-out's diagonals and angle, and bonds of the same width all round.
#include "schema/kit/plate_drawing.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

double cross_mm2(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

std::size_t count_of_cuts(const LineDrawing& drawing) {
  const auto at = std::ranges::find(drawing.layers, std::string("cut"), &LineLayer::name);
  return at == drawing.layers.end() ? 0 : at->paths.size();
}

solver::RubberPlates plates_with_a_cut_out() {
  solver::RubberPlates plates;
  plates.prestretch = 1.25;
  plates.cut_outs = {{1, {0.9, 0.8}}};
  return plates;
}

TEST(PlateDrawing, CutOutsHaveTheirDiagonals) {
  const KitFixture kit(4, 4);
  const solver::RubberPlates plates = plates_with_a_cut_out();
  for (int hole = 0; hole < 2; ++hole) {
    const auto corners = cut_out_mm(kit.sheet, plates, hole);
    for (int k = 0; k < 2; ++k) {
      const solver::Diagonal& diagonal =
          kit.mechanism.diagonals[static_cast<std::size_t>(2 * hole + k)];
      const Vector2d flat = kit.sheet.point_mm(diagonal.to) - kit.sheet.point_mm(diagonal.from);
      const Vector2d along =
          corners[static_cast<std::size_t>(k + 2)] - corners[static_cast<std::size_t>(k)];
      const double ratio = hole == 0 ? 0.8 : k == 0 ? 0.9 : 0.8;
      EXPECT_LT((along - ratio * flat).norm(), 1e-9) << hole << " " << k;
    }
  }
  // A plate with no cut-out of its own is the hole, made smaller.
  const auto corners = cut_out_mm(kit.sheet, plates, 0);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto vertex = [&](std::size_t at) {
      const auto& diagonal = kit.mechanism.diagonals[at % 2];
      return kit.sheet.point_mm(at < 2 ? diagonal.from : diagonal.to);
    };
    const std::size_t next = (k + 1) % 4;
    EXPECT_LT((corners[next] - corners[k] - 0.8 * (vertex(next) - vertex(k))).norm(), 1e-9);
  }
}

// Every corner of the engraved line is as far from the cut on both its sides as the bonds are wide.
TEST(PlateDrawing, BondsGoRoundEveryPlate) {
  const KitFixture kit(4, 4);
  KitOptions options;
  options.bond_mm = 6;
  options.kerf_mm = 0.2;
  const std::vector<LineDrawing> pages =
      kit_plate_sheets(kit.sheet, plates_with_a_cut_out(), options, "plates").beds;
  ASSERT_EQ(pages.size(), 1U);
  const LineDrawing& drawing = pages.front();
  const auto layer = [&](const std::string& name) -> const LineLayer& {
    return *std::ranges::find(drawing.layers, name, &LineLayer::name);
  };
  const auto& cuts = layer("cut").paths;
  std::vector<DrawnPath> lines;
  for (const DrawnPath& path : layer("engrave").paths) {
    if (path.closed && path.points_mm.size() == 4 &&
        (path.points_mm[0] - path.points_mm[2]).norm() > 20) {
      lines.push_back(path);
    }
  }
  ASSERT_EQ(cuts.size(), 2U);
  ASSERT_EQ(lines.size(), 2U);
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& cut = cuts[p].points_mm;
    ASSERT_EQ(cut.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2d along = (cut[(k + 1) % 4] - cut[k]).normalized();
      double least = 1e9;
      for (const Vector2d& corner : lines[p].points_mm) {
        least = std::min(least, std::abs(cross_mm2(along, corner - cut[k])));
      }
      EXPECT_NEAR(least, 6.1, 1e-9);
    }
    for (const Vector2d& point : cut) {
      EXPECT_GT((point - drawing.least_mm).minCoeff(), 4.9);
      EXPECT_GT((drawing.most_mm - point).minCoeff(), 4.9);
    }
  }
}

// Each bed with room for one plate carries one; a smaller bed is refused.
TEST(PlateDrawing, PlatesKeepToTheBed) {
  const KitFixture kit(4, 4);
  KitOptions options;
  options.bed_mm = Vector2d(150, 140);
  const auto drawings = [&] {
    return kit_plate_sheets(kit.sheet, plates_with_a_cut_out(), options, "plates").beds;
  };
  const std::vector<LineDrawing> beds = drawings();
  ASSERT_EQ(beds.size(), 2U);
  for (const LineDrawing& bed : beds) {
    EXPECT_EQ(bed.most_mm - bed.least_mm, *options.bed_mm);
    EXPECT_EQ(count_of_cuts(bed), 1U);
    for (const LineLayer& layer : bed.layers) {
      for (const DrawnPath& path : layer.paths) {
        for (const Vector2d& point : path.points_mm) {
          EXPECT_GE((point - bed.least_mm).minCoeff(), options.margin_mm - 1e-9) << layer.name;
          EXPECT_GE((bed.most_mm - point).minCoeff(), options.margin_mm - 1e-9) << layer.name;
        }
      }
    }
  }
  options.bed_mm = Vector2d(100, 80);
  try {
    drawings();
    FAIL() << "a plate beyond its bed";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_request);
    EXPECT_NE(std::string(error.what()).find("the plate of hole"), std::string::npos);
  }
}

}  // namespace
}  // namespace misalign::schema
