// Parts, their contours and the kerf, beside geometry of their own: areas by triangles, distances
// of parallel lines, distances of points to segments.
#include "schema/kit/kit_outline.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "schema/kit/chords.hpp"
#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

double distance_to_segment(const Vector2d& at, const Vector2d& p, const Vector2d& q) {
  const double along = std::clamp((at - p).dot(q - p) / (q - p).squaredNorm(), 0.0, 1.0);
  return (at - p - along * (q - p)).norm();
}

double distance_to_ring(const Vector2d& at, const Ring& ring) {
  double least = INFINITY;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    least = std::min(least, distance_to_segment(at, ring[i], ring[(i + 1) % ring.size()]));
  }
  return least;
}

// Of a panel, as two triangles.
double panel_area(const solver::Sheet& sheet, int facet) {
  const auto& v = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  const auto triangle = [&](int a, int b, int c) {
    Eigen::Matrix2d m;
    m << sheet.point_mm(b) - sheet.point_mm(a), sheet.point_mm(c) - sheet.point_mm(a);
    return 0.5 * std::abs(m.determinant());
  };
  return triangle(v[0], v[1], v[2]) + triangle(v[2], v[3], v[0]);
}

TEST(KitParts, EightPanelsOfAnEightByEightAreHeldByBallJointsAlone) {
  const KitFixture kit(8, 8);
  const auto parts = kit_parts(kit.sheet, CreaseCut::score);
  ASSERT_EQ(parts.size(), 9u);
  EXPECT_EQ(parts[0].facets.size(), 64u - 18 - 8);
  std::set<std::string> loose;
  for (std::size_t p = 1; p < parts.size(); ++p) {
    ASSERT_EQ(parts[p].facets.size(), 1u);
    EXPECT_TRUE(parts[p].creases.empty());
    loose.insert(panel_label(kit.sheet, parts[p].facets[0]));
  }
  EXPECT_EQ(loose, (std::set<std::string>{"r2c2", "r2c4", "r3c3", "r3c5", "r4c2", "r4c4", "r5c3",
                                          "r5c5"}));
  std::size_t creases = 0;
  for (const KitPart& part : parts) creases += part.creases.size();
  EXPECT_EQ(creases, kit.mechanism.creases.size());
  EXPECT_EQ(kit_parts(kit.sheet, CreaseCut::cut).size(), 64u - 18);
}

TEST(KitParts, AGridCutsCreasesBetweenItsCellsAndNoOthers) {
  const KitFixture kit(6, 6);
  const KitPart whole = kit_parts(kit.sheet, CreaseCut::score)[0];
  const auto pieces = divided(kit.sheet, whole, 2, 3);
  std::size_t facets = 0;
  for (const KitPart& piece : pieces) {
    facets += piece.facets.size();
    std::set<std::pair<int, int>> cells;
    for (const int f : piece.facets) {
      const auto& place = kit.base.sheet.places[static_cast<std::size_t>(f)];
      cells.emplace(place[0] / 3, place[1] / 2);
    }
    EXPECT_EQ(cells.size(), 1u);
  }
  EXPECT_EQ(facets, whole.facets.size());
}

// Each contour is one walk without a vertex twice, also where two openings touch, and together they
// hold the panels' area.
TEST(KitOutline, ContoursAreSimpleAndHoldThePanels) {
  for (const auto& [rows, columns, holes] :
       {std::tuple(4, 4, "checkerboard-odd"), std::tuple(6, 8, "checkerboard-odd"),
        std::tuple(8, 8, "checkerboard-odd"), std::tuple(6, 6, "checkerboard-even")}) {
    const KitFixture kit(rows, columns, holes);
    for (const CreaseCut crease : {CreaseCut::score, CreaseCut::cut}) {
      for (const KitPart& part : kit_parts(kit.sheet, crease)) {
        const PartOutline outline = part_outline(kit.sheet, part, {}, 0);
        double area = 0, panels = 0;
        for (const int f : part.facets) panels += panel_area(kit.sheet, f);
        for (std::size_t r = 0; r < outline.rings.size(); ++r) {
          const double inside = signed_area_mm2(outline.rings[r]);
          EXPECT_EQ(inside > 0, r == 0) << "contour " << r;
          area += inside;
        }
        EXPECT_NEAR(area, panels, 1e-7);
        EXPECT_TRUE(outline.slits.empty());
        for (const auto& walk : part_walks(kit.sheet, part)) {
          EXPECT_EQ(std::set<int>(walk.begin(), walk.end()).size(), walk.size());
        }
      }
    }
  }
}

TEST(KitOutline, AKerfMovesEveryLineByHalfOfItAwayFromTheMaterial) {
  constexpr double kKerf_mm = 0.3;
  const KitFixture kit(8, 8);
  for (const KitPart& part : kit_parts(kit.sheet, CreaseCut::score)) {
    const PartOutline drawn = part_outline(kit.sheet, part, {}, 0),
                      cut = part_outline(kit.sheet, part, {}, kKerf_mm);
    ASSERT_EQ(cut.rings.size(), drawn.rings.size());
    for (std::size_t r = 0; r < cut.rings.size(); ++r) {
      const Ring &ring = cut.rings[r], &edge = drawn.rings[r];
      ASSERT_EQ(ring.size(), edge.size());
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2d along = (edge[(i + 1) % edge.size()] - edge[i]).normalized(),
                       outward(along.y(), -along.x());
        EXPECT_NEAR(outward.dot(ring[i] - edge[i]), kKerf_mm / 2, 1e-9);
        EXPECT_NEAR(outward.dot(ring[(i + 1) % ring.size()] - edge[i]), kKerf_mm / 2, 1e-9);
      }
      EXPECT_GT(signed_area_mm2(ring), signed_area_mm2(edge));  // holes are smaller, too
    }
  }
}

// Between openings that touch a neck would be left: a slit goes through each such ball joint.
TEST(KitOutline, SlitsJoinOpeningsThatTouch) {
  const KitFixture kit(4, 4);
  const KitPart part = kit_parts(kit.sheet, CreaseCut::score)[0];
  const PartOutline outline = part_outline(kit.sheet, part, {}, 0.2);
  ASSERT_EQ(outline.rings.size(), 3u);
  ASSERT_EQ(outline.slits.size(), 1u);
  const auto& slit = outline.slits[0];
  ASSERT_EQ(slit.size(), 3u);
  EXPECT_EQ(slit[1], kit.sheet.point_mm(kit.mechanism.balls.at(0).vertex));
  for (const std::size_t end : {0u, 2u}) {
    EXPECT_NEAR(std::min(distance_to_ring(slit[end], outline.rings[1]),
                         distance_to_ring(slit[end], outline.rings[2])),
                0, 1e-12);
    EXPECT_GT((slit[end] - slit[1]).norm(), 0.1);
  }
}

// Round a vertex: the disc of the tab's panel, and the others cut away; in one part, and with every
// panel by itself. The area is that of the panels, less sectors of these, and the disc's own.
TEST(KitOutline, TabsAreDiscsThatTheirNeighboursKeepClearOf) {
  constexpr double kKerf_mm = 0.2;
  const KitFixture kit(8, 8);
  KitOptions options;
  options.spring_bore_mm = 1.5;
  options.kerf_mm = kKerf_mm;
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  for (const CreaseCut crease : {CreaseCut::score, CreaseCut::cut}) {
    double area = 0, wanted = 0;
    for (const KitPart& part : kit_parts(kit.sheet, crease)) {
      for (const int f : part.facets) wanted += panel_area(kit.sheet, f);
      for (const Ring& ring : part_outline(kit.sheet, part, fittings, 0).rings) {
        area += signed_area_mm2(ring);
      }
      const PartOutline cut = part_outline(kit.sheet, part, fittings, kKerf_mm);
      for (const SpringTab& tab : fittings.tabs) {
        const Vector2d at = kit.sheet.point_mm(tab.vertex);
        double nearest = INFINITY;
        for (const Ring& ring : cut.rings) nearest = std::min(nearest, distance_to_ring(at, ring));
        const auto& has = part.facets;
        const bool is_here = std::binary_search(has.begin(), has.end(), tab.facet);
        EXPECT_GE(nearest, is_here ? tab.radius_mm + kKerf_mm / 2 - kChordOff_mm
                                   : tab.clear_mm - kKerf_mm / 2 - kChordOff_mm);
        for (const int f : has) {
          const auto& v = kit.base.sheet.facets[static_cast<std::size_t>(f)];
          const auto k = std::find(v.begin(), v.end(), tab.vertex) - v.begin();
          if (k == 4) continue;
          const Vector2d one = kit.sheet.point_mm(v[(k + 1) % 4]) - at,
                         other = kit.sheet.point_mm(v[(k + 3) % 4]) - at;
          const double angle = std::acos(one.dot(other) / one.norm() / other.norm());
          wanted += f == tab.facet ? tab.radius_mm * tab.radius_mm * (std::numbers::pi - angle / 2)
                                   : -tab.clear_mm * tab.clear_mm * angle / 2;
        }
      }
      // Nothing is left there for a slit.
      for (const auto& slit : cut.slits) {
        EXPECT_TRUE(std::none_of(fittings.tabs.begin(), fittings.tabs.end(), [&](const auto& tab) {
          return kit.sheet.point_mm(tab.vertex) == slit[1];
        }));
      }
    }
    EXPECT_NEAR(area, wanted, 0.1 * static_cast<double>(fittings.tabs.size()));
  }
}

TEST(KitOutline, AcuteCornersAreCutOffWhereTheirMitreWouldBeTooLong) {
  for (const double half_deg : {5.0, 10.0, 14.0, 15.0, 30.0, 80.0}) {
    const double half = half_deg * std::numbers::pi / 180;
    const Ring needle = {{0, 0},
                         {100 * std::cos(half), -100 * std::sin(half)},
                         {100 * std::cos(half), 100 * std::sin(half)}};
    const auto moved = offset_ring(needle, 1);
    ASSERT_TRUE(moved) << half_deg;
    const bool is_cut_off = 1 / std::sin(half) > kMitreLimit;
    double farthest = 0;
    for (const Vector2d& point : *moved) {
      EXPECT_GE(distance_to_ring(point, needle), 1 - 1e-9) << half_deg;  // nothing is lost
      farthest = std::max(farthest, -point.x());
    }
    EXPECT_NEAR(farthest, is_cut_off ? kMitreLimit : 1 / std::sin(half), 1e-9) << half_deg;
    EXPECT_EQ(moved->size(), half_deg < 14.4 ? 4u : half_deg == 80 ? 5u : 3u) << half_deg;
  }
}

TEST(KitOutline, AKerfThatClosesAnOpeningIsRefusedWithOneThatFits) {
  const Ring opening = {{0, 0}, {0, 10}, {10, 10}, {10, 0}};  // clockwise
  EXPECT_TRUE(offset_ring(opening, 4.99));
  EXPECT_FALSE(offset_ring(opening, 5.01));
  // A waist that closes while every edge is still there.
  const Ring waist = {{0, 0}, {0, 20}, {9, 11}, {11, 11}, {20, 20}, {20, 0}, {11, 9}, {9, 9}};
  EXPECT_TRUE(offset_ring(waist, 0.9));
  EXPECT_FALSE(offset_ring(waist, 1.2));
  const KitFixture kit(4, 4);
  const KitPart part = kit_parts(kit.sheet, CreaseCut::score)[0];
  try {
    part_outline(kit.sheet, part, {}, 90);
    FAIL() << "a kerf wider than a panel";
  } catch (const UserError& error) {
    EXPECT_EQ(error.cause(), Cause::bad_request);
    const std::string words = error.what();
    const double fits = std::stod(words.substr(words.find("at most ") + 8));
    EXPECT_GT(fits, 60);
    EXPECT_NO_THROW(part_outline(kit.sheet, part, {}, fits));
    EXPECT_THROW(part_outline(kit.sheet, part, {}, 1.01 * fits), UserError);
  }
}

}  // namespace
}  // namespace misalign::schema
