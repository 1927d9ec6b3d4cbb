// Pins under load: what they take, against angles and axes of the folded panels' coordinates.
#include "solver/motion/pin_friction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

struct PinnedSheet : testing::Test {
  // Where a panel has turned to, by three of its corners.
  Matrix3d frame(const Matrix3Xd& shape_mm, int facet) const {
    const auto& corners = test.base.sheet.facets[static_cast<std::size_t>(facet)];
    const Vector3d along = (shape_mm.col(corners[1]) - shape_mm.col(corners[0])).normalized(),
                   other = shape_mm.col(corners[2]) - shape_mm.col(corners[0]),
                   up = along.cross(other).normalized();
    Matrix3d axes;
    axes << along, up.cross(along), up;
    return axes;
  }
  const Matrix3Xd& shape_mm(int deg) const {
    return own.sheet.shapes_mm()[static_cast<std::size_t>(deg - 1)];
  }
  // By how much b's panel turns as seen from a's, for each rad of the pilot.
  double turn_rate(int a, int b, int deg) const {
    const auto seen = [&](int at_deg) -> Matrix3d {
      return frame(shape_mm(at_deg), a).transpose() * frame(shape_mm(at_deg), b);
    };
    const Eigen::AngleAxisd turned(seen(deg - 1).transpose() * seen(deg + 1));
    return turned.angle() / (2 * kRadPerDeg);
  }
  PinStudy study(double stiffness_n_per_mm = 50, double own_mm = 0) const {
    ReleaseOptions options;
    options.sheet.springs().stiffness_n_per_mm = stiffness_n_per_mm;
    return *study_pins(own.sheet, options, own_mm);
  }

  const TestSheet test{6, 6};
  const FlatVertices vertices_mm = test.shifted(golden("table1_odd.json").at("displacements_mm"));
  const OwnSheet own{test.base, vertices_mm - test.base.sheet.vertices_mm};
};

TEST_F(PinnedSheet, LosesWhatItsForcesAndTurnsAre) {
  const FoldingWay& way = *own.sheet.way();
  const EnergyModel deploying(way, own.model.shape(), test.base, {});
  Matrix3Xd flat_mm = Matrix3Xd::Zero(3, vertices_mm.cols());
  flat_mm.topRows<2>() = vertices_mm;
  const PinStudy pins = study();
  for (const int deg : {36, 20, 5}) {
    SCOPED_TRACE(deg);
    Deployment held{};
    Deployment::Row row{};
    row.pilot_deg = deg;
    row.x = way.x_of(deg);
    held.rows = {row};
    const JointForces forces =
        find_joint_forces(deploying, own.model.shape(), test.base, held, {.in_motion = false});
    // Forces are seen by the first panel, which lies flat.
    const Matrix3d to_flat = frame(flat_mm, own.sheet.panels().facets[0]) *
                             frame(shape_mm(deg), own.sheet.panels().facets[0]).transpose();
    double in_middle = 0, at_ends = 0, balls = 0;
    for (std::size_t c = 0; c < own.sheet.mechanism().creases.size(); ++c) {
      const Crease& crease = own.sheet.mechanism().creases[c];
      const auto first = 3 * static_cast<Index>(c);
      const Vector3d force = forces.crease_force_n.block<1, 3>(0, first).transpose(),
                     moment = forces.crease_moment_n_mm.block<1, 3>(0, first).transpose();
      const Vector3d b_from_a =
          to_flat * (shape_mm(deg).col(crease.b) - shape_mm(deg).col(crease.a));
      const double length_mm = b_from_a.norm();
      const Vector3d axis = b_from_a / length_mm;
      // A force at b and its opposite at a turn about the middle by b_from_a x force.
      const Vector3d across = force - axis * axis.dot(force);
      const Vector3d couple = moment.cross(b_from_a) / b_from_a.squaredNorm();
      EXPECT_LE((b_from_a.cross(couple) - moment).norm(), 1e-9 * (1 + moment.norm()));
      const double rate = turn_rate(crease.left, crease.right, deg);
      in_middle += rate * across.norm();
      at_ends += rate * ((across / 2 + couple).norm() + (across / 2 - couple).norm());
    }
    for (std::size_t b = 0; b < own.sheet.mechanism().balls.size(); ++b) {
      const BallJoint& ball = own.sheet.mechanism().balls[b];
      balls += turn_rate(ball.from_facet, ball.to_facet, deg) *
               forces.ball_force_n.block<1, 3>(0, 3 * static_cast<Index>(b)).norm();
    }
    ASSERT_GT(balls, 0.1 * in_middle);
    // Rows lie apart by 8 %: the rate at this angle is between two of them, as a power of it.
    const auto loss = [&](const PinFriction& of) {
      std::size_t k = 0;
      while (of.rows[k + 1].pilot_deg > deg) ++k;
      const PinFriction::Row &above = of.rows[k], &below = of.rows[k + 1];
      const double share =
          std::log(deg / below.pilot_deg) / std::log(above.pilot_deg / below.pilot_deg);
      return below.loss_n * std::pow(above.loss_n / below.loss_n, share);
    };
    // Differences over 2 degrees are off by a share of 1e-4 (third derivatives), rows by less.
    constexpr double kWithin = 2e-3;
    EXPECT_NEAR(loss(pins.in_middle) / (in_middle + balls), 1, kWithin);
    EXPECT_NEAR(loss(pins.at_ends) / (at_ends + balls), 1, kWithin);
  }
}

// Forces and moments go with the springs: what locks is a length.
TEST_F(PinnedSheet, DoesNotDependOnTheSprings) {
  const PinStudy stiff = study(50), soft = study(0.3);
  EXPECT_NEAR(*soft.in_middle.critical_mm, *stiff.in_middle.critical_mm, 1e-9);
  EXPECT_NEAR(*soft.at_ends.critical_mm, *stiff.at_ends.critical_mm, 1e-9);
  EXPECT_LT(*stiff.at_ends.critical_mm, *stiff.in_middle.critical_mm);
}

// With the energy at the start, from coordinates, over the sum of the losses from degree to degree.
TEST_F(PinnedSheet, GetsToFlatWithItsEnergy) {
  const PinStudy pins = study();
  const auto energy = [&](int deg) {
    double sum = 0;
    for (const Diagonal& d : own.sheet.mechanism().diagonals) {
      const double longer = (shape_mm(deg).col(d.from) - shape_mm(deg).col(d.to)).norm() -
                            (vertices_mm.col(d.from) - vertices_mm.col(d.to)).norm();
      sum += 25 * longer * longer;
    }
    return sum;
  };
  for (const PinFriction* of : {&pins.in_middle, &pins.at_ends}) {
    double loss = 0;  // by trapezoids over the logarithm of the angle, flat where there is none
    for (std::size_t k = 0; k + 1 < of->rows.size(); ++k) {
      const PinFriction::Row &above = of->rows[k], &below = of->rows[k + 1];
      loss += 0.5 * std::log(above.pilot_deg / below.pilot_deg) * kRadPerDeg *
              (above.loss_n * above.pilot_deg + below.loss_n * below.pilot_deg);
    }
    // Losses go with the angle's square there, so that trapezoids are off by (0.075 * 3)^2 / 12.
    EXPECT_NEAR(*of->critical_mm, energy(36) / loss, 6e-3 * *of->critical_mm);
    // More than it bears at the start: it does not even set out.
    EXPECT_EQ(of->stall_deg(2 * of->rows.front().locks_mm()), 36);
    const double some_mm = of->rows[10].locks_mm();
    EXPECT_NEAR(of->stall_deg(some_mm).value(), of->rows[10].pilot_deg, 1e-6);
    EXPECT_FALSE(of->stall_deg(0.5 * of->locks_first().locks_mm()));
  }
}

TEST_F(PinnedSheet, RefusesWhatLiesAboveItsStart) {
  const auto refused = study_pins(own.sheet, {}, 0.1, 40);
  ASSERT_TRUE(refused.fault());
  EXPECT_EQ(refused.fault()->name, "margin_to_deg");
}

}  // namespace
}  // namespace misalign::solver
