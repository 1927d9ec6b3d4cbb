// Plates hinged on their faces, one after another round a vertex or a hole, by rigid motions of the
// flat plates about hinge lines off the mid-plane.
#include "schema/kit/kit_hinges.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/schema/kit/kit_fixture.hpp"

namespace misalign::schema {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// A folded sheet, by its flat vertices, its fold angles and, at ball joints alone, its shape.
class Plates {
 public:
  Plates(const KitFixture& kit, Eigen::Index row) : kit_(kit), row_(row) {}

  // How far the last of plates of 1 mm stands off the first, round whole vertices and holes.
  double worst() const {
    double worst = 0;
    const auto& pattern = kit_.sheet.base().sheet;
    for (const int v : solver::interior_vertices(pattern)) {
      const std::vector<int> around = panels_at({v}, flat(v));
      if (around.size() == 4) worst = std::max(worst, gap(around));
    }
    for (const int hole : kit_.sheet.base().holes) {
      const auto& corners = pattern.facets[static_cast<std::size_t>(hole)];
      Vector3d middle = Vector3d::Zero();
      for (const int v : corners) middle += 0.25 * flat(v);
      worst = std::max(worst, gap(panels_at({corners.begin(), corners.end()}, middle)));
    }
    return worst;
  }

 private:
  Vector3d flat(int v) const {
    const Eigen::Vector2d at = kit_.sheet.point_mm(v);
    return {at.x(), at.y(), 0};
  }
  std::array<int, 4> corners(int facet) const {
    return kit_.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  }
  // Those with one of these corners, by their direction from a middle.
  std::vector<int> panels_at(const std::vector<int>& vertices, const Vector3d& middle) const {
    std::vector<std::pair<double, int>> found;
    for (const int facet : kit_.sheet.panels().facets) {
      Vector3d centre = Vector3d::Zero();
      bool is_there = false;
      for (const int v : corners(facet)) {
        centre += 0.25 * flat(v);
        is_there = is_there || std::count(vertices.begin(), vertices.end(), v) > 0;
      }
      const Vector3d way = centre - middle;
      if (is_there) found.emplace_back(std::atan2(way.y(), way.x()), facet);
    }
    std::sort(found.begin(), found.end());
    std::vector<int> facets;
    for (const auto& [angle, facet] : found) facets.push_back(facet);
    return facets;
  }
  std::vector<int> shared(int one, int other) const {
    std::vector<int> both;
    for (const int v : corners(one)) {
      const auto others = corners(other);
      if (std::count(others.begin(), others.end(), v) > 0) both.push_back(v);
    }
    return both;
  }
  static Isometry3d turn_about(const Vector3d& point, const Eigen::Matrix3d& turn) {
    return Eigen::Translation3d(point) * Isometry3d(turn) * Eigen::Translation3d(-point);
  }
  Eigen::Matrix3d turned(int facet) const {
    Eigen::Matrix<double, 3, 4> from, to;
    const auto around = corners(facet);
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<std::size_t>(k);
      from.col(k) = flat(around[at]);
      to.col(k) = kit_.sheet.shapes_mm()[static_cast<std::size_t>(row_)].col(around[at]);
    }
    return Eigen::umeyama(from, to, false).topLeftCorner<3, 3>();
  }
  // From the flat place of one plate to that of the next one, which is counter-clockwise: where it
  // lies for who moves with the first.
  Isometry3d hinged(int one, int other) const {
    const std::vector<int> ends = shared(one, other);
    if (ends.size() == 1) {  // a ball joint in the mid-plane
      return turn_about(flat(ends[0]), turned(one).transpose() * turned(other));
    }
    const auto& creases = kit_.sheet.mechanism().creases;
    const auto crease = std::find_if(creases.begin(), creases.end(), [&](const auto& c) {
      return std::min(ends[0], ends[1]) == c.a && std::max(ends[0], ends[1]) == c.b;
    });
    const double fold_rad = kit_.sheet.history().fold_angle_deg(row_, crease - creases.begin()) *
                            std::numbers::pi / 180;
    Vector3d centre = Vector3d::Zero();
    for (const int v : corners(other)) centre += 0.25 * (flat(v) - flat(ends[0]));
    Vector3d along = (flat(ends[1]) - flat(ends[0])).normalized();
    if (along.cross(centre).z() < 0)
      along = -along;  // the next plate on its left: a valley lifts it
    const Vector3d on_face(0, 0, fold_rad > 0 ? 0.5 : -0.5);
    return turn_about(flat(ends[0]) + on_face,
                      Eigen::AngleAxisd(fold_rad, along).toRotationMatrix());
  }
  double gap(const std::vector<int>& around) const {
    Isometry3d last = Isometry3d::Identity();
    for (std::size_t k = 0; k < around.size(); ++k) {
      last = last * hinged(around[k], around[(k + 1) % around.size()]);
    }
    EXPECT_LT((last.linear() - Eigen::Matrix3d::Identity()).norm(), 1e-6);  // angles are whole
    const Vector3d there = flat(corners(around[0])[0]);
    return (last * there - there).norm();
  }

  const KitFixture& kit_;
  const Eigen::Index row_;
};

TEST(KitHinges, PlatesHingedOnTheirFacesMissAsRigidMotionsSay) {
  for (const double most_mm : {0.0, 0.4}) {
    const KitFixture kit(6, 6, "checkerboard-odd", most_mm);
    double worst = 0;
    for (Eigen::Index row = 0; row < kit.sheet.rows_shown(); row += 1) {
      worst = std::max(worst, Plates(kit, row).worst());
      if (row % 20 != 0) continue;
      const FaceHingeMisfit found = face_hinge_misfit(kit.sheet, row + 1);
      // Turns that are open by 1e-6 move hinges a panel's width apart by as much.
      EXPECT_NEAR(found.per_mm, worst, 1e-4) << row;
      EXPECT_FALSE(found.place(kit.sheet).empty());
    }
    EXPECT_GT(worst, 0.5);
  }
  const KitFixture flat(4, 4);
  EXPECT_EQ(face_hinge_misfit(flat.sheet, 0).loop, nullptr);
}

}  // namespace
}  // namespace misalign::schema
