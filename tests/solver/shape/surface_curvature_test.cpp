#include "solver/shape/surface_curvature.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "../blocks.hpp"
#include "solver/shape/shape.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

constexpr double kBent_mm = 900, kOut_mm = 240, kLevel_mm = 20;

// A surface with its principal curvatures at the middle, times kBent_mm, the first along a
// direction of the plane.
struct Bent {
  std::function<double(double, double)> height_mm;
  std::array<double, 2> curvatures;
  double along_deg;
};

std::vector<Bent> bent_surfaces() {
  constexpr double r = kBent_mm;
  return {
      {[](double x, double) { return std::sqrt(r * r - x * x) - r; }, {1, 0}, 0},
      {[](double, double y) { return r - std::sqrt(r * r - y * y); }, {-1, 0}, 90},
      {[](double x, double y) { return std::sqrt(r * r - x * x - y * y) - r; }, {1, 1}, 0},
      {[](double x, double y) { return (2 * x * x - y * y) / (4 * r); }, {-1, 0.5}, 0},
      {[](double x, double y) { return x * std::tan(y / r) + x * y / (2 * r); }, {1.5, -1.5}, -45}};
}

// Vertices of an uneven grid at both levels of a surface, in a frame of their own.
Eigen::Matrix3Xd corrugated(const Bent& bent, const Eigen::Isometry3d& frame, int rows,
                            Eigen::VectorXd& sides) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> off(-0.01, 0.01);
  Eigen::Matrix3Xd vertices_mm(3, rows * rows);
  sides.resize(rows * rows);
  for (int v = 0; v < rows * rows; ++v) {
    const double x = kOut_mm * (2.0 * (v % rows) / (rows - 1) - 1 + off(random)),
                 y = kOut_mm * (2.0 * (v / rows) / (rows - 1) - 1 + off(random)), h = 1e-3;
    sides(v) = v / rows % 2 ? 1 : -1;
    const Vector3d normal(-(bent.height_mm(x + h, y) - bent.height_mm(x - h, y)) / (2 * h),
                          -(bent.height_mm(x, y + h) - bent.height_mm(x, y - h)) / (2 * h), 1);
    vertices_mm.col(v) =
        frame * (Vector3d(x, y, bent.height_mm(x, y)) + sides(v) * kLevel_mm * normal.normalized());
  }
  return vertices_mm;
}

// A circle's second derivative grows by 3 / 2 of the square of (place / radius), and a fit takes a
// mean of it; the square of (level / radius) is far smaller. At a corner places are 1.4 times as
// far out.
TEST(SurfaceCurvature, IsThatOfKnownSurfacesInAnyPose) {
  constexpr double kShare = 3 * (kOut_mm / kBent_mm) * (kOut_mm / kBent_mm);
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  for (const Bent& bent : bent_surfaces()) {
    for (int pose = 0; pose < 5; ++pose) {
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
              .normalized();
      const Eigen::Isometry3d frame =
          Eigen::Translation3d(100 * normal(random), 50, -70 * normal(random)) * turn;
      Eigen::VectorXd sides;
      const Eigen::Matrix3Xd vertices_mm = corrugated(bent, frame, 7, sides);
      auto found = surface_curvature(vertices_mm, sides, turn * Vector3d(0.3, 0.2, 1));
      ASSERT_TRUE(found);
      // Either of equal magnitudes is the first.
      const bool is_swapped = std::abs(found->per_mm[0] * kBent_mm - bent.curvatures[0]) > 0.5;
      if (is_swapped) std::swap(found->per_mm[0], found->per_mm[1]);
      for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(found->per_mm[k] * kBent_mm, bent.curvatures[k],
                    kShare * std::abs(bent.curvatures[0]))
            << bent.along_deg;
      }
      EXPECT_NEAR(found->half_depth_mm, kLevel_mm, kShare * kLevel_mm);
      // The fourth order of a circle's height at a corner.
      EXPECT_LT(found->rms_mm, std::pow(std::sqrt(2) * kOut_mm, 4) / (8 * std::pow(kBent_mm, 3)));
      if (bent.curvatures[0] == bent.curvatures[1]) continue;
      const double along = bent.along_deg * std::numbers::pi / 180;
      const Vector3d direction = turn * Vector3d(std::cos(along), std::sin(along), 0);
      EXPECT_GT(std::abs(direction.dot(found->directions.col(is_swapped))), std::cos(0.03));
    }
  }
}

TEST(SurfaceCurvature, IsExactOfAQuadric) {
  const Bent bowl{
      [](double x, double y) { return -(x * x + 3 * x * y - y * y / 2) / 4000; }, {}, 0};
  Eigen::VectorXd sides;
  Eigen::Matrix3Xd vertices_mm = corrugated(bowl, Eigen::Isometry3d::Identity(), 6, sides);
  // Even places, whose plane is not tilted: each with its opposite, at the same height.
  for (Eigen::Index v = 0; v < 18; ++v) {
    vertices_mm.col(35 - v) = vertices_mm.col(v).cwiseProduct(Vector3d(-1, -1, 1));
    sides(35 - v) = sides(v);
  }
  const auto found = surface_curvature(vertices_mm, sides, Vector3d::UnitZ());
  ASSERT_TRUE(found);
  Eigen::Matrix2d bend;
  bend << 2, 3, 3, -1;
  const double mean = 0.5, half = std::sqrt(1.5 * 1.5 + 9);  // of its eigenvalues
  EXPECT_NEAR(found->per_mm[0], (mean + half) / 4000, 1e-12);
  EXPECT_NEAR(found->per_mm[1], (mean - half) / 4000, 1e-12);
  EXPECT_NEAR(found->half_depth_mm, kLevel_mm, 1e-9);
  EXPECT_LT(found->rms_mm, 1e-9);
  const Eigen::Vector2d first = found->directions.col(0).head<2>();
  EXPECT_LT((bend * first - (mean + half) * first).norm(), 1e-9);
}

// Folds whose vertices all have three valleys, as of turned quads, have one level.
TEST(SurfaceCurvature, NeedsNoLevels) {
  Eigen::Matrix3Xd vertices_mm(3, 25);
  for (int v = 0; v < 25; ++v) {
    const double x = 80 * (v % 5 - 2), y = 80 * (v / 5 - 2);
    vertices_mm.col(v) << x, y, (y * y - 3 * x * x) / 4000;
  }
  const auto found =
      surface_curvature(vertices_mm, Eigen::VectorXd::Constant(25, -1), -Vector3d::UnitZ());
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->per_mm[0], -6.0 / 4000, 1e-12) << "a bowl from below";
  EXPECT_NEAR(found->per_mm[1], 2.0 / 4000, 1e-12);
  EXPECT_EQ(found->half_depth_mm, 0);
}

TEST(SurfaceCurvature, IsNoneOfASheetThatIsRolledUp) {
  for (const double arc : {0.2, 1.9}) {
    Eigen::Matrix3Xd vertices_mm(3, 25);
    for (int v = 0; v < 25; ++v) {
      const double turn = arc * (v % 5 - 2) / 2;
      vertices_mm.col(v) << 100 * std::sin(turn), 50 * arc * (v / 5 - 2), 100 * std::cos(turn);
    }
    const Eigen::VectorXd sides = Eigen::VectorXd::Ones(25);
    EXPECT_EQ(surface_curvature(vertices_mm, sides, Vector3d::UnitZ()).has_value(), arc < 1);
  }
}

// Three rows of levels are a parabola.
TEST(SurfaceCurvature, NeedsFourRows) {
  for (const int rows : {3, 4}) {
    Eigen::VectorXd sides;
    const Eigen::Matrix3Xd vertices_mm =
        corrugated(bent_surfaces()[2], Eigen::Isometry3d::Identity(), rows, sides);
    EXPECT_EQ(surface_curvature(vertices_mm, sides, Vector3d::UnitZ()).has_value(), rows == 4);
  }
}

TEST(SurfaceCurvature, KnowsTheLevelsOfTheBase) {
  const DrawableSheet sheets(6, 6);
  const Model model(sheets.base, all_vertices(sheets.base.sheet), {}, 0);
  SheetSolver solver(model);
  const Sheet base(solver, Eigen::Matrix2Xd::Zero(2, model.base().sheet.vertex_count()));
  const std::vector<int> inner = interior_vertices(model.base().sheet);
  const Eigen::VectorXd sides = level_sides(model.base());
  EXPECT_EQ(sides.cwiseAbs().sum(), static_cast<double>(inner.size()));
  for (const double pilot_deg : {20.0, 90.0, 140.0}) {
    ShapeTarget target;
    target.surface = plane();
    const Eigen::Matrix3Xd& folded_mm = base.at(pilot_deg).vertices_mm;
    const ShapePose pose = lay_base(model.base(), folded_mm, target);
    for (const int v : inner) EXPECT_EQ(sides(v), target.sides(v)) << v;
    const auto flat = surface_curvature(base, pilot_deg);
    ASSERT_TRUE(flat);
    EXPECT_LT(std::abs(flat->per_mm[0]), 1e-9);
    EXPECT_NEAR(flat->half_depth_mm, pose.half_depth_mm, 1e-6);
  }
  EXPECT_FALSE(surface_curvature(base, 181));
}

TEST(SurfaceCurvature, IsThatOfAShapedSheet) {
  const DrawableSheet sheets(6, 6);
  const Model model(sheets.base, all_vertices(sheets.base.sheet), {}, 0);
  SheetSolver solver(model);
  const double radius_mm = 5 * 480;
  ShapeOptions options;
  options.kind = ShapeKind::free;
  options.target.surface = cylinder(-radius_mm, false);
  const auto found = shape(solver, options);
  ASSERT_TRUE(found);
  const auto bent = surface_curvature(Sheet(solver, found->shifts_mm), options.at_deg);
  ASSERT_TRUE(bent);
  // Inner vertices lie within a third of the width from the middle, and outer ones of these beyond
  // a quarter: a parabola through zero and there may be as high as the largest misfit.
  const double share = 1.5 / (15 * 15) + 2 * found->max_mm / (120 * 120) * radius_mm;
  EXPECT_LT(share, 0.03);
  EXPECT_NEAR(-bent->per_mm[0] * radius_mm, 1, share);
  EXPECT_NEAR(bent->per_mm[1] * radius_mm, 0, share);
}

}  // namespace
}  // namespace misalign::solver
