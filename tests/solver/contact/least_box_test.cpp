// The least box around shapes whose least boxes are known.
#include "solver/contact/least_box.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace misalign::solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3d random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
      .normalized()
      .toRotationMatrix();
}

// Corners of a cuboid in any pose, with points inside that turn its principal axes away.
TEST(LeastBox, IsTheCuboidItself) {
  const unsigned seed = 20261128;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  const Vector3d sides_mm(120, 70, 15);
  for (int trial = 0; trial < 20; ++trial) {
    Matrix3Xd points_mm(3, 40);
    for (int k = 0; k < 40; ++k) {
      const Vector3d at = k < 8 ? Vector3d(k & 1, k >> 1 & 1, k >> 2 & 1)
                                : Vector3d(std::pow(part(random), 4), part(random) * 0.2, 0.9);
      points_mm.col(k) = at.cwiseProduct(sides_mm);
    }
    const Vector3d found_mm = least_box_mm(random_rotation(random) * points_mm);
    EXPECT_LT((found_mm - sides_mm).norm(), 0.02) << "seed " << seed << ", trial " << trial;
  }
}

// Of a regular tetrahedron a cube; of a right triangle in a plane a rectangle on its legs.
TEST(LeastBox, IsKnownOfSimpleShapes) {
  std::mt19937 random(7);
  Matrix3Xd tetrahedron(3, 4), triangle(3, 3);
  tetrahedron << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1;
  triangle << 0, 30, 0, 0, 0, 40, 0, 0, 0;
  for (int trial = 0; trial < 5; ++trial) {
    const Vector3d cube = least_box_mm(random_rotation(random) * 50 * tetrahedron);
    EXPECT_NEAR(cube.prod() / 1e6, 1, 1e-3);
    const Vector3d rectangle = least_box_mm(random_rotation(random) * triangle);
    EXPECT_NEAR(rectangle(0) * rectangle(1) / 1200, 1, 1e-3);
    EXPECT_NEAR(rectangle(2), 0, 0.01);
  }
}

}  // namespace
}  // namespace misalign::solver
