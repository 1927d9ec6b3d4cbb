// Pieces on beds: nothing overlaps, everything is within; perforations; DXF of hostile words.
#include "schema/kit/kit_layout.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "schema/exchange/dxf_pen.hpp"
#include "schema/kit/kit_drawing.hpp"
#include "schema/kit/kit_notes.hpp"
#include "schema/kit/part_item.hpp"
#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

TEST(KitLayout, NothingOverlapsAndEverythingIsOnABed) {
  const unsigned seed = 19;
  RecordProperty("seed", static_cast<int>(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> size(5, 120), gap_size(0, 10);
  for (int trial = 0; trial < 300; ++trial) {
    const double gap = gap_size(random);
    const Vector2d bed(150, trial % 3 == 0 ? INFINITY : 125);
    std::vector<LayoutBox> boxes;
    for (int k = 0; k < 30; ++k) boxes.push_back({{size(random), size(random)}, k % 2 == 0});
    boxes.push_back({{40, 140}, true});  // turned where the bed is lower
    std::vector<std::tuple<int, Vector2d, Vector2d>> corners;
    const auto laid = lay_out(boxes, bed, gap);
    ASSERT_EQ(laid.size(), boxes.size());
    for (std::size_t k = 0; k < laid.size(); ++k) {
      ASSERT_TRUE(!laid[k].turned || boxes[k].may_turn);
      Vector2d extent = boxes[k].size_mm;
      if (laid[k].turned) std::swap(extent.x(), extent.y());
      const Vector2d least = laid[k].at_mm, most = least + extent;
      EXPECT_GE(least.minCoeff(), 0);
      EXPECT_LE((most - bed).maxCoeff(), 1e-6);
      for (const auto& [other_bed, other_least, other_most] : corners) {
        if (other_bed != laid[k].bed) continue;
        const double apart =
            std::max((least - other_most).maxCoeff(), (other_least - most).maxCoeff());
        ASSERT_GE(apart, gap - 1e-6);
      }
      corners.emplace_back(laid[k].bed, least, most);
    }
    EXPECT_EQ(laid.back().turned, std::isfinite(bed.y()));
  }
  EXPECT_FALSE(fits_bed({{151, 10}, true}, {150, 125}));
  EXPECT_TRUE(fits_bed({{125, 150}, true}, {150, 125}));
  EXPECT_FALSE(fits_bed({{125, 150}, false}, {150, 125}));
}

TEST(KitTables, FitTheNarrowestBedInBlocks) {
  const KitFixture kit(6, 6);
  KitOptions options;
  options.spring_bore_mm = 1.5;
  const auto springs = kit_springs(kit.sheet, kit_fittings(kit.sheet, options));
  for (const double height_mm : {14.0, 30.0, 70.0}) {
    for (const KitItem& table : kit_tables(kit.sheet, springs, {0, 1, 2, 3}, height_mm)) {
      EXPECT_LE(table.size_mm().x(), kLeastHeading_mm);
      EXPECT_LE(table.size_mm().y(), height_mm);
    }
  }
}

TEST(KitTables, ABedThatIsTooLowForThemIsRefused) {
  const KitFixture kit(4, 4, "checkerboard-odd", 0.1, 10);  // smaller than a table of one row
  KitOptions options;
  int refused = 0, laid_out = 0;
  for (double height_mm = 30; height_mm < 60; ++height_mm) {
    options.bed_mm = Vector2d(130, height_mm);
    try {
      laid_out += !kit_drawings(kit.sheet, options, "low").beds.empty();
    } catch (const UserError& error) {
      refused += std::string(error.what()).find("a table of the notes does not fit (") < 100;
    }
  }
  EXPECT_GT(refused, 0);
  EXPECT_GT(laid_out, 0);
}

TEST(KitPerforation, BeginsAndEndsWithABridge) {
  KitOptions options;
  options.dash_mm = 4;
  options.bridge_mm = 1;
  options.kerf_mm = 0.2;
  for (const double length : {0.5, 5.9, 6.0, 6.1, 11.0, 80.0, 89.44271909999159}) {
    const auto dashes = perforation({1, 2}, Vector2d(1, 2) + length * Vector2d(0.6, 0.8), options);
    ASSERT_EQ(dashes.size(), static_cast<std::size_t>((length - 1) / 5 + 1e-9)) << length;
    double at = 0, bridge = -1;
    for (const DrawnPath& dash : dashes) {
      ASSERT_EQ(dash.points_mm.size(), 2u);
      const double from = (dash.points_mm[0] - Vector2d(1, 2)).norm() - 0.1,
                   to = (dash.points_mm[1] - Vector2d(1, 2)).norm() + 0.1;
      EXPECT_NEAR(to - from, 4, 1e-9);  // as it comes out
      if (bridge < 0) bridge = from - at;
      EXPECT_NEAR(from - at, bridge, 1e-9);
      at = to;
    }
    if (dashes.empty()) continue;
    EXPECT_NEAR(length - at, bridge, 1e-9);
    EXPECT_GE(bridge, 1 - 1e-9);
  }
}

TEST(KitHatching, StaysWithinAContour) {
  const Ring hook = {{0, 0}, {0, 50}, {50, 50}, {50, 40}, {10, 40}, {10, 0}};
  const auto lines = hatching(hook);
  EXPECT_GT(lines.size(), 8u);
  for (const DrawnPath& line : lines) {
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Vector2d at = line.points_mm[0] + share * (line.points_mm[1] - line.points_mm[0]);
      EXPECT_TRUE(at.x() > 0 && at.y() > 0 && at.x() < 50 && at.y() < 50 &&
                  (at.x() < 10 || at.y() > 40))
          << at.transpose();
    }
  }
}

// Words of unknown origin stay one value on one line: nothing begins another group or a code.
TEST(DxfPen, WordsAreOneLineOfAscii) {
  LineDrawing drawing{"", {0, 0}, {100, 100}, {{"note", kCyan, LayerUse::mark, {}, {}, {}}}};
  drawing.layers[0].texts.push_back({{5, 5}, "a\n  0\nLINE 50%%d ^J \xc3\xa4 \xf0\x9f\x98\x80", 2});
  const std::string dxf = dxf_of(drawing);
  EXPECT_NE(dxf.find("a\\u000a  0\\u000aLINE 50% % d ^ J \\U+00E4 ?"), std::string::npos);
  for (const char c : dxf) EXPECT_TRUE(c == '\n' || c == '\r' || (c >= ' ' && c <= '~'));
}

}  // namespace
}  // namespace misalign::schema
