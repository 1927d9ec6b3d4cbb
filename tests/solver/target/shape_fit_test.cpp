#include "solver/target/shape_fit.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace misalign::solver {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

// Vertices at a half depth above and below a sphere, in turn, seen from another frame.
struct OnASphere {
  OnASphere() : folded_mm(3, 25), flat_mm(2, 25) {
    target.surface = sphere(kRadius_mm);
    target.sides.resize(25);
    for (int v = 0; v < 25; ++v) {
      flat_mm.col(v) << 60.0 * (v % 5 - 2), 60.0 * (v / 5 - 2);
      const double side = v % 2 == 0 ? 1 : -1;
      target.sides(v) = side;
      const Vector3d out = Vector3d(flat_mm(0, v), flat_mm(1, v), kRadius_mm).normalized();
      folded_mm.col(v) = (kRadius_mm + side * kDepth_mm) * out - kRadius_mm * Vector3d::UnitZ();
    }
    target.flat_mm = flat_mm;
    target.weights = Eigen::MatrixXd::Identity(25, 25);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.3, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    folded_mm = ((turn * folded_mm).colwise() + Vector3d(100, -40, 12)).eval();
  }
  static constexpr double kRadius_mm = 900, kDepth_mm = 21;
  ShapeTarget target;
  Matrix3Xd folded_mm;
  Eigen::Matrix2Xd flat_mm;
};

TEST(ShapeFit, FindsThePoseAndTheDepth) {
  const OnASphere sheet;
  ShapePose near;
  near.move_mm = -sheet.folded_mm.rowwise().mean();
  near.half_depth_mm = 5;
  const ShapePose pose = fitted_pose(sheet.target, sheet.folded_mm, near);
  const ShapeMisfit off = misfit(sheet.target, sheet.folded_mm, pose);
  EXPECT_NEAR(pose.half_depth_mm, OnASphere::kDepth_mm, 1e-6);
  EXPECT_LT(off.rms_mm(), 1e-6);
  EXPECT_LT(off.mm.tail<3>().cwiseAbs().maxCoeff(), 1e-6) << "in the middle, and not turned";
}

// Central differences of 1e-4 mm or rad are right to some 1e-8 of distances of 100 mm.
TEST(ShapeFit, HasTheGradientsOfDifferences) {
  const OnASphere sheet;
  ShapeTarget target = sheet.target;
  ShapePose pose;
  pose.turn = Eigen::AngleAxisd(0.2, Vector3d(0.2, 1, -0.4).normalized()).toRotationMatrix();
  pose.move_mm = {-90, 30, 5};
  pose.half_depth_mm = 17;
  for (const auto& surface : {sphere(900), saddle(-500), helicoid(700), cylinder(600, true)}) {
    target.surface = surface->scaled(1);
    const ShapeMisfit now = misfit(target, sheet.folded_mm, pose);
    constexpr double kStep = 1e-4;
    for (int k = 0; k < 7; ++k) {
      const Eigen::Matrix<double, 7, 1> by = kStep * Eigen::Matrix<double, 7, 1>::Unit(k);
      const Eigen::VectorXd slope = (misfit(target, sheet.folded_mm, pose.after(by)).mm -
                                     misfit(target, sheet.folded_mm, pose.after(-by)).mm) /
                                    (2 * kStep);
      EXPECT_LT((slope - now.by_pose.col(k)).cwiseAbs().maxCoeff(), 2e-5) << k;
    }
    for (int v : {0, 7, 24}) {
      for (int k = 0; k < 3; ++k) {
        Matrix3Xd up = sheet.folded_mm, down = sheet.folded_mm;
        up(k, v) += kStep;
        down(k, v) -= kStep;
        const Eigen::VectorXd slope =
            (misfit(target, up, pose).mm - misfit(target, down, pose).mm) / (2 * kStep);
        EXPECT_NEAR(slope(v), now.by_mm(k, v), 1e-7);
        EXPECT_LT((slope.tail<3>() - now.hold_by_mm.col(3 * v + k)).cwiseAbs().maxCoeff(), 1e-7);
      }
    }
  }
}

}  // namespace
}  // namespace misalign::solver
