// Plates beside coordinates of their own: corners of two plates that are turned about one axis,
// distances of points to segments.
#include "schema/kit/plate_edges.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "schema/files/user_error.hpp"
#include "schema/kit/plate_ring.hpp"
#include "tests/schema/kit/deploying_kit.hpp"

namespace misalign::schema {
namespace {

using Eigen::Vector2d;

constexpr double kThickness_mm = 2, kFrom_deg = 60;

KitOptions plate_options(CreaseCut crease) {
  KitOptions options;
  options.crease = crease;
  options.plates = {.thickness_mm = kThickness_mm, .trim_mm = 5, .barrel_mm = 2.4};
  options.from_deg = kFrom_deg;
  return options;
}

// A point of a plate, by its distance from the axis and its height, where the plate is turned by
// half the fold; the other plate is its mirror image.
double beyond_middle(double away_mm, double height_mm, double fold_rad) {
  const Eigen::Rotation2Dd turn(fold_rad / 2);
  return -(turn * Vector2d(away_mm, height_mm)).x();
}

// The largest fold of a crease's kind, by normals of the folded panels.
double largest_fold_rad(const solver::Sheet& sheet, bool valley) {
  double largest_rad = 0;
  for (Eigen::Index row = 0; row <= *sheet.row_at(kFrom_deg); ++row) {
    const Eigen::Matrix3Xd& at = sheet.shapes_mm()[static_cast<std::size_t>(row)];
    const auto normal = [&](int facet) {
      const auto& v = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
      return Eigen::Vector3d(
          (at.col(v[1]) - at.col(v[0])).cross(at.col(v[3]) - at.col(v[0])).normalized());
    };
    for (const solver::Crease& crease : sheet.mechanism().creases) {
      if (sheet.mechanism().is_valley(crease) != valley) continue;
      const Eigen::Vector3d left = normal(crease.left), right = normal(crease.right);
      largest_rad = std::max(largest_rad, std::atan2(left.cross(right).norm(), left.dot(right)));
    }
  }
  return largest_rad;
}

// Square edges of film hinges meet at the largest fold, and not before; bevels lie on one another
// within a degree; a pin's edges are clear of the barrel and of what the other plate has at it.
TEST(PlateEdges, MeetAtTheLargestFold) {
  const DeployingKit kit;
  for (const CreaseCut crease : {CreaseCut::film, CreaseCut::bevel, CreaseCut::pin}) {
    const PlateEdges edges(kit.sheet, plate_options(crease));
    for (const int facet : kit.sheet.panels().facets) {
      for (std::size_t k = 0; k < 4; ++k) {
        const PlateEdge& edge = edges.edge(facet, k);
        if (edge.crease < 0) {
          EXPECT_EQ(edge.back_mm, 0);
          continue;
        }
        const double fold_rad = largest_fold_rad(kit.sheet, edge.valley),
                     half_mm = kThickness_mm / 2;
        if (crease == CreaseCut::film) {
          EXPECT_NEAR(beyond_middle(edge.back_mm, half_mm, fold_rad), 0, 1e-9);
          EXPECT_LT(beyond_middle(edge.back_mm, half_mm, 0.99 * fold_rad), 0);
        } else if (crease == CreaseCut::bevel) {
          EXPECT_LE(beyond_middle(edge.bevel_mm, half_mm, fold_rad), 1e-9);
          EXPECT_GT(beyond_middle(edge.bevel_mm, half_mm, fold_rad + 0.036), 0);  // 2 degrees more
          EXPECT_EQ(edge.bevel_deg, std::round(edge.bevel_deg));
        } else {
          EXPECT_GE(edge.back_mm, 1.2);
          // The corner of a knuckle as thick as the plate, where it crosses the middle.
          const double across_mm = half_mm * std::tan(fold_rad / 2);
          EXPECT_NEAR(beyond_middle(across_mm, half_mm, fold_rad), 0, 1e-9);
          EXPECT_GE(edge.back_mm, std::hypot(across_mm, half_mm) - 1e-9);
        }
      }
    }
  }
}

// Plates above films meet with the upper corners of valleys' edges; those of mountains, which open,
// reach the axis.
TEST(PlateEdges, OffsetPlatesMeetAtValleysAlone) {
  const DeployingKit kit;
  KitOptions options = plate_options(CreaseCut::offset);
  options.plates->spacer_mm = 0.5;
  const PlateEdges edges(kit.sheet, options);
  EXPECT_EQ(edges.reach_mm(), kThickness_mm + 0.5);
  for (const bool valley : {false, true}) {
    const PlateEdge& edge = edges.hinge(valley);
    const double fold_rad = largest_fold_rad(kit.sheet, valley);
    if (!valley) {
      EXPECT_EQ(edge.back_mm, 0);
      continue;
    }
    EXPECT_NEAR(beyond_middle(edge.back_mm, kThickness_mm + 0.5, fold_rad), 0, 1e-9);
    EXPECT_LT(beyond_middle(edge.back_mm, kThickness_mm + 0.5, 0.99 * fold_rad), 0);
  }
}

double distance_to_contour(const Vector2d& at, const PlanePoints& ring) {
  double least = INFINITY;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2d &p = ring[i], d = ring[(i + 1) % ring.size()] - p;
    const double share = std::clamp((at - p).dot(d) / d.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (at - p - share * d).norm());
  }
  return least;
}

// A tab's disc, with all of its thickness, lies nearer to its vertex than its neighbours, whose
// distance from the vertex folding does not change; its neck is as wide as one without hinges.
TEST(PlateEdges, TabsAreClearOfTheirNeighboursAndAsStrong) {
  const DeployingKit kit;
  KitOptions options = plate_options(CreaseCut::film);
  options.spring_bore_mm = 1.5;
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  ASSERT_FALSE(fittings.tabs.empty());
  const double bare_mm = 0.75 + options.bore_edge_mm;
  for (const SpringTab& tab : fittings.tabs) {
    const Vector2d at_mm = kit.sheet.point_mm(tab.vertex);
    for (const int facet : kit.sheet.panels().facets) {
      const auto& around = kit.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
      const auto corner = std::ranges::find(around, tab.vertex);
      if (corner == around.end()) continue;
      const PlanePoints ring = plate_contour(kit.sheet, facet, fittings);
      if (facet != tab.facet) {
        EXPECT_GT(distance_to_contour(at_mm, ring), std::hypot(tab.radius_mm, kThickness_mm / 2));
        continue;
      }
      std::vector<Vector2d> neck;  // where sides meet the disc
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vector2d &p = ring[i], &q = ring[(i + 1) % ring.size()];
        const double from = (p - at_mm).norm(), to = (q - at_mm).norm();
        EXPECT_GE(from, tab.radius_mm - 1e-9);
        if (std::abs(from - tab.radius_mm) < 1e-9 && to > tab.radius_mm + 1) neck.push_back(p);
        if (std::abs(to - tab.radius_mm) < 1e-9 && from > tab.radius_mm + 1) neck.push_back(q);
      }
      ASSERT_EQ(neck.size(), 2u);
      const double bare_neck_mm = 2 * bare_mm * PanelCorner(kit.sheet, facet, tab.vertex).sine;
      EXPECT_GE((neck[0] - neck[1]).norm(), bare_neck_mm - 1e-9);
    }
  }
  for (const Bore& bore : fittings.bores) {
    const PlanePoints ring = plate_contour(kit.sheet, bore.facet, fittings);
    EXPECT_GE(distance_to_contour(bore.centre_mm, ring),
              bore.diameter_mm / 2 + options.bore_edge_mm - 1e-6);
  }
}

// Sides lie where they are asked for, trims at their distance from the vertex, and a plate that is
// too thick says so.
TEST(PlateEdges, ContoursAreSetBackAndTrimmed) {
  const DeployingKit kit;
  KitOptions options = plate_options(CreaseCut::film);
  const KitFittings fittings = kit_fittings(kit.sheet, options);
  for (const int facet : kit.sheet.panels().facets) {
    const auto& around = kit.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
    const auto ring = plate_ring(kit.sheet, facet, fittings, fittings.edges.back_mm(facet)).value();
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2d from = kit.sheet.point_mm(around[k]),
                     along = (kit.sheet.point_mm(around[(k + 1) % 4]) - from).normalized();
      for (const Vector2d& end : ring.side(k)) {
        EXPECT_NEAR(cross(along, end - from), fittings.edges.edge(facet, k).back_mm, 1e-9);
      }
      const double trim_mm = fittings.edges.trim_mm(facet, k);
      if (trim_mm == 0) continue;
      EXPECT_EQ(trim_mm, 5);
      double least = INFINITY;
      for (const Vector2d& point : ring.points) {
        least =
            std::min(least, PanelCorner(kit.sheet, facet, around[k]).bisector.dot(point - from));
      }
      EXPECT_GE(least, trim_mm - 1e-9);
    }
  }
  options.plates->thickness_mm = 400;
  const KitFittings thick = kit_fittings(kit.sheet, options);
  EXPECT_THROW(plate_contour(kit.sheet, kit.sheet.mechanism().creases[0].left, thick), UserError);
}

TEST(PlateEdges, HingesOnFacesNeedConsent) {
  const DeployingKit kit;
  KitOptions options = plate_options(CreaseCut::butt);
  EXPECT_THROW(PlateEdges(kit.sheet, options), UserError);
  options.plates->allows_misfit = true;
  const PlateEdges edges(kit.sheet, options);
  EXPECT_NE(edges.words().find("miss by"), std::string::npos);
  for (const int facet : kit.sheet.panels().facets) EXPECT_EQ(edges.back_mm(facet)[0], 0);
  // Little folding leaves little misfit.
  options.plates->allows_misfit = false;
  options.from_deg = 2;
  EXPECT_NO_THROW(PlateEdges(kit.sheet, options));
}

}  // namespace
}  // namespace misalign::schema
