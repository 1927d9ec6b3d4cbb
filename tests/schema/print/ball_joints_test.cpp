// Printed ball joints in folded sheets, by coordinates of the panels' corners.
#include "schema/print/ball_joints.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "schema/files/user_error.hpp"
#include "schema/kit/panel_corner.hpp"
#include "tests/schema/kit/deploying_kit.hpp"

namespace misalign::schema {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

constexpr double kTrim_mm = 6;

KitOptions ball_options(double from_deg) {
  KitOptions options;
  options.crease = CreaseCut::bevel;
  options.plates = {.thickness_mm = 4, .trim_mm = kTrim_mm};
  options.joints = {.kind = solver::JointKind::ball, .clearance_mm = 0.3};
  options.ball_mm = 5;
  options.from_deg = from_deg;
  return options;
}

std::vector<Solid> joints_alone(const solver::Sheet& sheet, const KitOptions& options) {
  std::vector<Solid> plates(sheet.panels().facets.size());
  add_ball_joints(sheet, options, plates);
  return plates;
}

// A rigid motion that lays the corners of a flat panel onto those of the folded one.
Eigen::Isometry3d motion_of(const std::array<int, 4>& around, const Matrix3Xd& flat_mm,
                            const Matrix3Xd& at_mm) {
  Matrix3Xd from(3, 4), to(3, 4);
  for (int k = 0; k < 4; ++k) {
    from.col(k) = flat_mm.col(around[static_cast<std::size_t>(k)]);
    to.col(k) = at_mm.col(around[static_cast<std::size_t>(k)]);
  }
  return Eigen::Isometry3d(Eigen::umeyama(from, to, false));
}

struct Joints {
  explicit Joints(double from_deg)
      : options(ball_options(from_deg)), plates(joints_alone(kit.sheet, options)) {
    flat_mm = Matrix3Xd::Zero(3, kit.sheet.vertices_mm().cols());
    flat_mm.topRows<2>() = kit.sheet.vertices_mm();
  }

  const std::array<int, 4>& around(int facet) const {
    return kit.sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
  }

  // The least distance of sockets from necks and balls, over states up to an angle.
  double least_gap_mm(double to_deg) const {
    const BallSizes sizes(options);
    double least_mm = INFINITY;
    for (const solver::BallJoint& joint : kit.sheet.mechanism().balls) {
      const auto& facets = kit.sheet.panels().facets;
      const auto to =
          static_cast<std::size_t>(std::ranges::find(facets, joint.to_facet) - facets.begin());
      const Vector3d vertex_mm = flat_mm.col(joint.vertex);
      const Eigen::Vector2d along = PanelCorner(kit.sheet, joint.from_facet, joint.vertex).bisector;
      for (Eigen::Index row = 0; row <= *kit.sheet.row_at(to_deg); ++row) {
        const Matrix3Xd& at_mm = kit.sheet.shapes_mm()[static_cast<std::size_t>(row)];
        const Eigen::Isometry3d back =
            motion_of(around(joint.from_facet), flat_mm, at_mm).inverse() *
            motion_of(around(joint.to_facet), flat_mm, at_mm);
        for (const Vector3d& point : plates[to].vertices_mm) {
          if ((point - vertex_mm).norm() > sizes.outer_mm + 0.1) continue;  // other joints', stems
          const Vector3d off = back * point - vertex_mm;
          const double height_mm = off.head<2>().dot(along),
                       beside_mm = (off - height_mm * Vector3d(along.x(), along.y(), 0)).norm();
          least_mm = std::min(least_mm, off.norm() - sizes.ball_mm);
          if (height_mm > 0) least_mm = std::min(least_mm, beside_mm - sizes.neck_mm);
        }
      }
    }
    return least_mm;
  }

  const DeployingKit kit;
  const KitOptions options;
  const std::vector<Solid> plates;
  Matrix3Xd flat_mm;
};

TEST(BallJoints, SocketsClearBallsAndNecksUpToTheAngleOfUse) {
  const Joints joints(60);
  // Chords of the sockets' inside cut in by 0.005 mm, twice where both directions have chords.
  EXPECT_NEAR(joints.least_gap_mm(60), 0.15, 0.012);
  EXPECT_LT(joints.least_gap_mm(90), 0) << "necks run into sockets behind it";
}

TEST(BallJoints, ShellsAreClosedAndHaveTheirVolumes) {
  const Joints joints(60);
  const BallSizes sizes(joints.options);
  double volume_mm3 = 0;
  for (const Solid& plate : joints.plates) {
    std::map<std::pair<int, int>, int> sides;
    for (const auto& [a, b, c] : plate.triangles) {
      for (const auto& side : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) ++sides[side];
      const auto at = [&](int k) { return plate.vertices_mm[static_cast<std::size_t>(k)]; };
      volume_mm3 += at(a).dot(at(b).cross(at(c))) / 6;
    }
    for (const auto& [side, count] : sides) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(sides.contains({side.second, side.first}));
    }
  }
  // A ball without the cap in its neck, the neck, and the stem; of a socket the shell without the
  // cone: each joint has its own, from a tenth to a half of a whole shell.
  const double r = sizes.ball_mm, n = sizes.neck_mm, h = std::sqrt(r * r - n * n),
               pi = std::numbers::pi, cap = pi * (r - h) * (r - h) * (2 * r + h) / 3,
               ball = 4 * pi / 3 * r * r * r - cap + pi * n * n * (kTrim_mm + 2 - h),
               stem = pi * n * n *
                      (kTrim_mm + 2 - sizes.socket_mm - 0.25 * (sizes.outer_mm - sizes.socket_mm)),
               shell = 4 * pi / 3 * (std::pow(sizes.outer_mm, 3) - std::pow(sizes.socket_mm, 3));
  const auto count = static_cast<double>(joints.kit.sheet.mechanism().balls.size());
  const double sockets = volume_mm3 / count - ball - stem;
  EXPECT_GT(sockets, 0.5 * shell);
  EXPECT_LT(sockets, 0.9 * shell);
}

TEST(BallJoints, BallsThatWouldNotBeHeldAreRefused) {
  const DeployingKit kit;
  EXPECT_THROW(joints_alone(kit.sheet, ball_options(150)), UserError);
  KitOptions options = ball_options(60);
  options.plates->trim_mm = 3;
  EXPECT_THROW(joints_alone(kit.sheet, options), UserError);
  options = ball_options(60);
  options.joints->clearance_mm = 0;
  EXPECT_THROW(joints_alone(kit.sheet, options), UserError);
}

}  // namespace
}  // namespace misalign::schema
