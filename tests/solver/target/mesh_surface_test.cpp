#include "solver/target/mesh_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace misalign::solver {
namespace {

using Eigen::Vector3d;
using HeightOfPlace = std::function<double(double, double)>;

constexpr double kMeshed_mm = 200, kMeshRadius_mm = 500;

double ball_mm(double x, double y) {
  return std::sqrt(kMeshRadius_mm * kMeshRadius_mm - x * x - y * y) - kMeshRadius_mm;
}
double bowl_mm(double x, double y) { return (x * x + 3 * y * y - x * y) / 2000 + x / 8; }

// A square with uneven edges of about h and diagonals in both directions, its triangles facing up
// and down.
std::unique_ptr<TargetSurface> meshed(const HeightOfPlace& height_mm, double h_mm) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> off(-0.2 * h_mm, 0.2 * h_mm);
  const int side = static_cast<int>(2 * kMeshed_mm / h_mm) + 1;
  Eigen::Matrix3Xd vertices_mm(3, side * side);
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const double x = k * h_mm - kMeshed_mm + off(random), y = i * h_mm - kMeshed_mm + off(random);
      vertices_mm.col(i * side + k) << x, y, height_mm(x, y);
      if (i + 1 == side || k + 1 == side) continue;
      const int a = i * side + k, b = a + 1, c = a + side, d = c + 1;
      if (off(random) > 0) {
        triangles.insert(triangles.end(), {{a, b, c}, {b, c, d}});
      } else {
        triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
      }
    }
  }
  Eigen::Matrix3Xi columns(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    columns.col(static_cast<Eigen::Index>(t)) = triangles[t];
  }
  return mesh_surface(vertices_mm, columns);
}

// Largest errors of distances and of normals at points beside the surface up to this far out.
std::pair<double, double> errors_beside(const TargetSurface& surface,
                                        const HeightOfPlace& height_mm, double out_mm) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-out_mm, out_mm), away(-30, 30);
  std::pair<double, double> most;
  for (int k = 0; k < 500; ++k) {
    const double x = place(random), y = place(random), mm = away(random), h = 1e-3;
    const Vector3d normal = Vector3d(-(height_mm(x + h, y) - height_mm(x - h, y)) / (2 * h),
                                     -(height_mm(x, y + h) - height_mm(x, y - h)) / (2 * h), 1)
                                .normalized();
    const SurfaceDistance found = surface.distance(Vector3d(x, y, height_mm(x, y)) + mm * normal);
    most.first = std::max(most.first, std::abs(found.mm - mm));
    most.second = std::max(most.second, (found.normal - normal).norm());
  }
  return most;
}

TEST(MeshSurface, IsAnyQuadricThroughItsVertices) {
  for (const double h_mm : {50.0, 20.0}) {
    const auto [mm, normal] = errors_beside(*meshed(bowl_mm, h_mm), bowl_mm, 0.7 * kMeshed_mm);
    EXPECT_LT(mm, 1e-10);
    EXPECT_LT(normal, 1e-9);  // differences of heights over 1e-3 mm
  }
}

// Errors stay below Taylor's remainder over an edge, and fall with its third power: by more than
// half an order above the second.
TEST(MeshSurface, ErrsByTheThirdPowerOfItsEdges) {
  const double out_mm = 0.8 * kMeshed_mm, square = kMeshRadius_mm * kMeshRadius_mm;
  const double third =
      3 * square * std::sqrt(2) * out_mm / std::pow(square - 2 * out_mm * out_mm, 2.5);
  double coarser = std::numeric_limits<double>::infinity();
  for (const double h_mm : {40.0, 20.0, 10.0, 5.0}) {
    const auto surface = meshed(ball_mm, h_mm);
    const auto [mm, normal] = errors_beside(*surface, ball_mm, out_mm);
    EXPECT_LT(mm, third * std::pow(h_mm, 3) / 6) << h_mm;
    EXPECT_LT(normal, third * std::pow(h_mm, 2) / 2) << h_mm;
    EXPECT_LT(mm, coarser / std::pow(2, 2.5)) << h_mm;
    coarser = mm;
  }
}

// Normals are gradients of distances, also beyond the rim, where the surface goes straight on.
TEST(MeshSurface, HasTheGradientOfItsDistance) {
  const auto surface = meshed(ball_mm, 40);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.3 * kMeshed_mm, 1.3 * kMeshed_mm), away(-30, 30);
  for (int k = 0; k < 200; ++k) {
    const Vector3d foot(place(random), place(random), 0);
    const double x = std::clamp(foot.x(), -kMeshed_mm, kMeshed_mm),
                 y = std::clamp(foot.y(), -kMeshed_mm, kMeshed_mm);
    const Vector3d point = foot + Vector3d(0, 0, ball_mm(x, y) + away(random));
    const SurfaceDistance found = surface->distance(point);
    const bool is_beyond = (foot - Vector3d(x, y, 0)).norm() > 0;
    constexpr double kStep_mm = 1e-4;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d step = kStep_mm * Vector3d::Unit(axis);
      const double rate =
          (surface->distance(point + step).mm - surface->distance(point - step).mm) /
          (2 * kStep_mm);
      // A foot beyond the rim has the rim's curvature only to first order.
      EXPECT_NEAR(rate, found.normal(axis), is_beyond ? 2e-3 : 1e-7) << point.transpose();
    }
  }
}

TEST(MeshSurface, GoesStraightOnBeyondItsRim) {
  const HeightOfPlace slope_mm = [](double x, double y) { return x / 3 - y / 5; };
  const auto [mm, normal] = errors_beside(*meshed(slope_mm, 80), slope_mm, 3 * kMeshed_mm);
  EXPECT_LT(mm, 1e-10);
  EXPECT_LT(normal, 1e-9);
}

// A vertex whose neighbours fix no quadric, as in a mesh of two triangles, keeps to a plane.
TEST(MeshSurface, IsAPlaneWhereThereAreFewVertices) {
  Eigen::Matrix3Xd vertices_mm(3, 4);
  vertices_mm << -100, 100, 100, -100,  //
      -100, -100, 100, 100,             //
      -20, 20, 30, -10;
  Eigen::Matrix3Xi triangles(3, 2);
  triangles << 0, 0,  //
      1, 2,           //
      2, 3;
  const HeightOfPlace height_mm = [](double x, double y) { return x / 5 + y / 20 + 5; };
  const auto surface = mesh_surface(vertices_mm, triangles);
  // Bends count a thousandth in the fit, their squares a millionth, over 200 mm.
  EXPECT_LT(errors_beside(*surface, height_mm, 100).first, 1e-4);
  EXPECT_LT(surface->curvature_per_mm(), 1e-7);
}

TEST(MeshSurface, ScalesItsHeights) {
  const auto whole = meshed(bowl_mm, 20), part = whole->scaled(0.5)->scaled(0.5);
  const HeightOfPlace lower_mm = [](double x, double y) { return bowl_mm(x, y) / 4; };
  EXPECT_LT(errors_beside(*part, lower_mm, 100).first, 1e-10);
  EXPECT_EQ(whole->scaled(0)->distance(Vector3d(10, -40, 7)).mm, 7);
  EXPECT_DOUBLE_EQ(part->curvature_per_mm(), whole->curvature_per_mm() / 4);
  // All second derivatives of the bowl, which are the same everywhere.
  Eigen::Matrix2d bend;
  bend << 2, -1, -1, 6;
  EXPECT_NEAR(whole->curvature_per_mm(), bend.norm() / 2000, 1e-10);
}

}  // namespace
}  // namespace misalign::solver
