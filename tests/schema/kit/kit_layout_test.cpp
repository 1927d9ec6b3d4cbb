// Items on beds with registration marks; perforations; DXF in inches, and of hostile words.
#include "schema/kit/kit_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "schema/exchange/dxf_pen.hpp"
#include "schema/kit/kit_drawing.hpp"
#include "schema/kit/part_item.hpp"
#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

KitItem panel_item(double width_mm, double height_mm) {
  KitItem item = empty_item();
  item.on(KitLayer::cut)
      .paths.push_back({{{0, 0}, {width_mm, 0}, {width_mm, height_mm}, {0, height_mm}}, true});
  return item;
}

const LineLayer& layer_named(const LineDrawing& drawing, const std::string& name) {
  return *std::ranges::find(drawing.layers, name, &LineLayer::name);
}

// Twelve panels of 60 x 60 with gaps of 5 on beds of 200 x 150: six on each, and marks in three
// corners, which six leave free.
TEST(KitLayout, MarksAreInThreeCornersOfEachBed) {
  KitOptions options;
  options.kerf_mm = 0.2;
  options.bed_mm = Vector2d(220, 155);
  const std::vector<KitItem> items(12, panel_item(60, 60));
  const KitSheets sheets = KitLayout(options).laid_out(items, "marks");
  EXPECT_EQ(sheets.beds.size(), 2U);
  EXPECT_NEAR(sheets.area_mm2, 12 * 3600, 1e-9);
  EXPECT_EQ(sheets.least_beds(), 2U);  // 43200 of 30450
  for (const LineDrawing& bed : sheets.beds) {
    const auto& marks = layer_named(bed, "registration").circles;
    ASSERT_EQ(marks.size(), 3U);
    const std::vector<Vector2d> centres = {{6.5, 6.5}, {213.5, 6.5}, {6.5, 148.5}};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LT((marks[k].centre_mm - centres[k]).norm(), 1e-9);
      EXPECT_NEAR(marks[k].radius_mm, 1.4, 1e-9);
      for (const DrawnPath& contour : layer_named(bed, "cut").paths) {
        Vector2d least = contour.points_mm[0], most = least;
        for (const Vector2d& point : contour.points_mm) {
          least = least.cwiseMin(point);
          most = most.cwiseMax(point);
        }
        const Vector2d off = (least - centres[k]).cwiseMax(centres[k] - most).cwiseMax(0);
        EXPECT_GE(off.norm(), 1.5 + options.gap_mm - 1e-9);
      }
    }
  }
}

TEST(KitLayout, AnItemLargerThanTheBedIsNamed) {
  KitOptions options;
  options.bed_mm = Vector2d(100, 80);
  const KitLayout layout(options);
  EXPECT_TRUE(layout.has_room(panel_item(40, 85).shape(options.turns)));  // turned
  layout.expect_room("panel r0c0", panel_item(40, 85));
  try {
    layout.expect_room("panel r0c0", panel_item(91, 30));
    FAIL() << "an item beyond its bed";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_request);
    EXPECT_NE(std::string(error.what()).find("panel r0c0 does not fit"), std::string::npos);
  }
}

// One page holds all items where there is no bed, and a strip for marks above and below them.
TEST(KitLayout, OneSheetIsAsLargeAsItsItemsNeed) {
  const KitOptions options;
  const KitSheets sheets = KitLayout(options).laid_out({panel_item(200, 80)}, "one");
  ASSERT_EQ(sheets.beds.size(), 1U);
  EXPECT_LT((sheets.size_mm - Vector2d(210, 80 + 2 * 8 + 10)).norm(), 1e-6);
}

TEST(KitSprings, EndAtTheAngleOfUse) {
  const KitFixture kit(4, 4);
  const double d_deg = kit.sheet.deploys_from_deg();
  ASSERT_GT(d_deg, 20);
  EXPECT_EQ(kit_rows(kit.sheet, std::nullopt), kit.sheet.rows_up_to_d());
  const Eigen::Index rows = kit_rows(kit.sheet, 20.0);
  EXPECT_NEAR(kit.sheet.history().stations[static_cast<std::size_t>(rows - 1)].pilot_deg, 20, 1e-9);
  KitOptions options;
  options.spring_bore_mm = 1.5;
  options.from_deg = 20;
  for (const KitSpring& spring : kit_of(kit.sheet, options, "").springs) {
    EXPECT_EQ(spring.length_mm.size(), static_cast<std::size_t>(rows) + 1);
  }
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

// Words of unknown origin stay one value on one line: nothing begins another group or a code.
TEST(DxfPen, WordsAreOneLineOfAscii) {
  LineDrawing drawing{"", {0, 0}, {100, 100}, {{"note", kCyan, LayerUse::mark, {}, {}, {}}}};
  drawing.layers[0].texts.push_back({{5, 5}, "a\n  0\nLINE 50%%d ^J \xc3\xa4 \xf0\x9f\x98\x80", 2});
  const std::string dxf = dxf_of(drawing);
  EXPECT_NE(dxf.find("a\\u000a  0\\u000aLINE 50% % d ^ J \\U+00E4 ?"), std::string::npos);
  for (const char c : dxf) EXPECT_TRUE(c == '\n' || c == '\r' || (c >= ' ' && c <= '~'));
}

// A length in inches is the number of millimetres by 25.4; header, page and entities agree.
TEST(DxfPen, InchesAreInHeaderAndEntities) {
  LineDrawing drawing{"", {0, 0}, {254, 127}, {{"cut", kBlack, LayerUse::cut, {}, {}, {}}}};
  drawing.layers[0].circles.push_back({{50.8, 25.4}, 12.7});
  drawing.unit = LengthUnit::inch;
  const std::string dxf = dxf_of(drawing);
  const auto follows = [&](const std::string& name, int value) {
    std::istringstream rest(dxf.substr(dxf.find(name) + name.size()));
    int code = 0, number = -1;
    rest >> code >> number;
    return code == 70 && number == value;
  };
  EXPECT_TRUE(follows("$INSUNITS", 1));
  EXPECT_TRUE(follows("$MEASUREMENT", 0));
  EXPECT_NE(dxf.find("CIRCLE"), std::string::npos);
  for (const char* number : {" 10\n2.0\n", " 20\n1.0\n", " 40\n0.5\n", " 10\n10.0\n"}) {
    EXPECT_NE(dxf.find(number), std::string::npos) << number;
  }
}

}  // namespace
}  // namespace misalign::schema
