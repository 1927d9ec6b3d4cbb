// Contact of panels and their largest thickness, against closed forms on the unshifted Miura-ori
// and conditions that a right answer fulfils. The sweep is tests/stress/contacts.cpp.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <random>

#include "solver/contact/plate_solid.hpp"
#include "tests/solver/sheets.hpp"
#include "tests/stress/signed_volumes.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

// A convex quadrilateral somewhere in a box of 2 mm.
PolygonCorners some_panel(std::mt19937& random) {
  std::uniform_real_distribution<double> within(-1, 1);
  const Vector3d middle(within(random), within(random), within(random));
  const Vector3d one = Vector3d(within(random), within(random), within(random)).normalized();
  const Vector3d other =
      one.cross(Vector3d(within(random), within(random), within(random))).normalized();
  PolygonCorners corners(3, 4);
  for (int k = 0; k < 4; ++k) {
    const double angle = kPi / 2 * (k + 0.4 * within(random));
    corners.col(k) = middle + std::cos(angle) * one + std::sin(angle) * other;
  }
  return corners;
}

bool is_within(const PolygonCorners& polygon, const Vector3d& point) {
  Vector3d normal = (polygon.col(1) - polygon.col(0)).cross(polygon.col(2) - polygon.col(0));
  normal.normalize();
  if (std::abs(normal.dot(point - polygon.col(0))) > 1e-12) return false;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vector3d edge = polygon.col((k + 1) % polygon.cols()) - polygon.col(k);
    if (normal.dot(edge.cross(point - polygon.col(k))) < -1e-12) return false;
  }
  return true;
}

// Both points are the panels' own, and a plane between the panels is as far from each corner: so
// none are closer. Crossing panels are those of which signs of volumes say it.
TEST(PanelDistance, PointsAndPlaneProveIt) {
  std::mt19937 random(1);
  int crossing = 0;
  for (int k = 0; k < 2000; ++k) {
    const PolygonCorners a = some_panel(random), b = some_panel(random);
    const Separation found = separation_of(a, b);
    ASSERT_TRUE(is_within(a, found.on_a) && is_within(b, found.on_b)) << k;
    ASSERT_NEAR((found.on_b - found.on_a).norm(), found.distance, 1e-14);
    const bool cross = stress::panels_cross(a, b);
    crossing += cross;
    ASSERT_EQ(found.distance == 0, cross) << k;
    if (cross) continue;
    const double between =
        (found.direction.transpose() * b).minCoeff() - (found.direction.transpose() * a).maxCoeff();
    ASSERT_NEAR(between, found.distance, 1e-12) << k;
  }
  EXPECT_GE(crossing, 100);
}

struct UnshiftedMiura : testing::Test {
  UnshiftedMiura()
      : model(sheet.base),
        solver(model),
        panels(solver.panels()),
        folded(solver, Eigen::Matrix2Xd::Zero(2, sheet.base.sheet.vertex_count())),
        motion(resolved_motion(folded).value()) {}

  PlateThickness thickness(double reach_deg, double trim_mm) const {
    return largest_thickness(panels, motion, motion.way().x_of(reach_deg), trim_mm);
  }

  const TestSheet sheet{4, 4};
  const Model model;
  SheetSolver solver;
  const Panels& panels;
  const Sheet folded;
  const PanelMotion motion;
  const double sector_rad = std::atan(2);  // 80 mm high, 40 mm across
};

// It folds flat: no panels meet before.
TEST_F(UnshiftedMiura, MeetsNowhereBeforeItIsFoldedFlat) {
  EXPECT_EQ(motion.resolved_until(), motion.way().end());
  const ContactFinder finder(panels, motion);
  EXPECT_FALSE(finder.first(motion.way().end()));
  EXPECT_GT(motion.way().end_deg(), 179);  // the last station: 180 degrees is singular
  // Panels of one row, two columns apart, stay parallel: w sin(alpha) sin(rho) between their
  // planes. No others without a common vertex are closer.
  for (const double pilot_deg : {120.0, 150.0, 170.0, 179.0}) {
    const ContactFinder::Clearance least = finder.clearance(motion.way().x_of(pilot_deg));
    EXPECT_NEAR(least.apart_mm, 80 * std::sin(sector_rad) * std::sin(pilot_deg * kRadPerDeg), 1e-9);
    EXPECT_NEAR(least.crease_deg, 180 - pilot_deg, 1e-9);
  }
}

// Trims limit: the corner of a trimmed panel on a straight crease, r / cos(alpha/2) from the
// vertex, over the panel opposite, which the panel between is folded away from by rho: r /
// cos(alpha/2) * sin(alpha) * sin(rho) = 2 r sin(alpha/2) sin(rho).
TEST_F(UnshiftedMiura, ThicknessThatTrimsAllow) {
  for (const double reach_deg : {150.0, 170.0}) {  // the foot is on the panel from 147 degrees on
    for (const double trim_mm : {2.0, 5.0}) {
      const double least_mm =
          2 * trim_mm * std::sin(sector_rad / 2) * std::sin(reach_deg * kRadPerDeg);
      const PlateThickness plates = thickness(reach_deg, trim_mm);
      EXPECT_EQ(plates.limit, PlateThickness::Limit::vertex);
      EXPECT_NEAR(plates.pilot_deg, reach_deg, 1e-9);
      EXPECT_LE(plates.thickness_mm, least_mm);
      EXPECT_NEAR(plates.thickness_mm, least_mm, 1.001e-3 * least_mm);  // its slack, and a little
    }
  }
}

// Tapers limit: towards one of its two parallel zigzag creases an inner panel has none of its whole
// thickness left when the taper, (t/2) tan(rho/2), is as wide as it: w sin(alpha).
TEST_F(UnshiftedMiura, ThicknessThatTapersAllow) {
  for (const double reach_deg : {120.0, 150.0, 170.0}) {
    const double most_mm = 2 * 80 * std::sin(sector_rad) / std::tan(reach_deg * kRadPerDeg / 2);
    EXPECT_NEAR(thickness(reach_deg, 2).taper_mm, most_mm, 1e-9 * most_mm);
  }
}

double area_of(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return twice / 2;
}

// What is left of a polygon where `height` (linear) is not negative.
template <class Height>
std::vector<Eigen::Vector2d> part_of(const std::vector<Eigen::Vector2d>& polygon,
                                     const Height& height) {
  std::vector<Eigen::Vector2d> part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
    const double at_p = height(p), at_q = height(q);
    if (at_p >= 0) part.push_back(p);
    if (at_p * at_q < 0) part.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  return part;
}

// Closed surfaces of the volume that areas of sections add up to.
TEST_F(UnshiftedMiura, PlatesAreClosedSolids) {
  const double thickness_mm = 3, trim_mm = 5;
  const FlatVertices& vertices_mm = sheet.base.sheet.vertices_mm;
  const std::vector<double> largest_rad = thickness(150, trim_mm).largest_rad;
  const auto outlines = trimmed_panels(panels, vertices_mm, trim_mm);
  const auto solids = plate_solids(panels, vertices_mm, thickness_mm, trim_mm, largest_rad);
  ASSERT_EQ(solids.size(), panels.corners.size());
  for (std::size_t panel = 0; panel < solids.size(); ++panel) {
    const PlateSolid& solid = solids[panel];
    std::map<std::pair<int, int>, int> edges;
    double volume_mm3 = 0;
    for (const auto& face : solid.faces) {
      const Vector3d origin = solid.vertices_mm[static_cast<std::size_t>(face[0])];
      for (std::size_t k = 0; k < face.size(); ++k) {
        ++edges[{face[k], face[(k + 1) % face.size()]}];
        if (k < 2) continue;
        volume_mm3 += origin.dot(solid.vertices_mm[static_cast<std::size_t>(face[k - 1])].cross(
                          solid.vertices_mm[static_cast<std::size_t>(face[k])])) /
                      6;
      }
    }
    for (const auto& [edge, times] : edges) {
      ASSERT_EQ(times, 1);
      ASSERT_TRUE(edges.contains({edge.second, edge.first}));
    }
    EXPECT_EQ(solid.vertices_mm.size() + solid.faces.size(), edges.size() / 2 + 2);

    std::vector<Eigen::Vector2d> outline;
    for (Index k = 0; k < outlines[panel].cols(); ++k) {
      outline.push_back(outlines[panel].col(k).head<2>());
    }
    const int slices = 400;
    double sections_mm3 = 0;
    for (int slice = 0; slice < slices; ++slice) {
      const double z_mm = ((slice + 0.5) / slices - 0.5) * thickness_mm;
      auto section = outline;
      for (std::size_t crease = 0; crease < panels.folds.size(); ++crease) {
        const FoldLine& fold = panels.folds[crease];
        const bool is_left = fold.left == static_cast<int>(panel);
        if ((!is_left && fold.right != static_cast<int>(panel)) || z_mm * fold.sign <= 0) continue;
        const Eigen::Vector2d a = vertices_mm.col(fold.a) - vertices_mm.col(0),
                              along =
                                  (vertices_mm.col(fold.b) - vertices_mm.col(fold.a)).normalized();
        const double cut_mm = std::abs(z_mm) * std::tan(largest_rad[crease] / 2);
        section = part_of(section, [&](const Eigen::Vector2d& p) {
          const double left_mm = along.x() * (p - a).y() - along.y() * (p - a).x();
          return (is_left ? left_mm : -left_mm) - cut_mm;
        });
      }
      sections_mm3 += area_of(section) * thickness_mm / slices;
    }
    EXPECT_NEAR(volume_mm3, sections_mm3, 1e-5 * volume_mm3);  // 1 / slices^2, of a small part
  }
}

}  // namespace
}  // namespace misalign::solver
