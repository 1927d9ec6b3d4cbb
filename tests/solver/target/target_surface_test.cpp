#include "solver/target/target_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

// A surface as a height of x and y, and the half width of the square that is sampled.
struct Described {
  std::unique_ptr<TargetSurface> surface;
  std::function<double(double, double)> height_mm;
};

std::vector<Described> described() {
  constexpr double kSurfaceRadius_mm = 700, kSpacing_mm = 20;
  std::vector<Described> all;
  all.push_back({cylinder(kSurfaceRadius_mm, false), [](double x, double) {
                   return std::sqrt(kSurfaceRadius_mm * kSurfaceRadius_mm - x * x) -
                          kSurfaceRadius_mm;
                 }});
  all.push_back({cylinder(-kSurfaceRadius_mm, true), [](double, double y) {
                   return kSurfaceRadius_mm -
                          std::sqrt(kSurfaceRadius_mm * kSurfaceRadius_mm - y * y);
                 }});
  all.push_back({sphere(kSurfaceRadius_mm), [](double x, double y) {
                   return std::sqrt(kSurfaceRadius_mm * kSurfaceRadius_mm - x * x - y * y) -
                          kSurfaceRadius_mm;
                 }});
  all.push_back({saddle(kSurfaceRadius_mm),
                 [](double x, double y) { return (x * x - y * y) / (2 * kSurfaceRadius_mm); }});
  all.push_back({helicoid(kSurfaceRadius_mm),
                 [](double x, double y) { return x * std::tan(y / kSurfaceRadius_mm); }});
  // A spline through a quadratic function is that function.
  Eigen::MatrixXd heights_mm(41, 41);
  const auto bowl = [](double x, double y) { return (x * x + 3 * y * y - x * y) / 2000; };
  for (int i = 0; i < 41; ++i) {
    for (int k = 0; k < 41; ++k) {
      heights_mm(i, k) = bowl((k - 20) * kSpacing_mm, (i - 20) * kSpacing_mm);
    }
  }
  all.push_back({height_grid(kSpacing_mm, heights_mm), bowl});
  return all;
}

// Points at known distances: feet, moved along normals by differences of the heights.
TEST(TargetSurface, KnowsThePointsBesideIt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-200, 200), away(-60, 60);
  for (const Described& sampled : described()) {
    for (int k = 0; k < 100; ++k) {
      const double x = place(random), y = place(random), mm = away(random), h = 1e-3;
      const Vector3d normal =
          Vector3d(-(sampled.height_mm(x + h, y) - sampled.height_mm(x - h, y)) / (2 * h),
                   -(sampled.height_mm(x, y + h) - sampled.height_mm(x, y - h)) / (2 * h), 1)
              .normalized();
      const Vector3d point = Vector3d(x, y, sampled.height_mm(x, y)) + mm * normal;
      const SurfaceDistance found = sampled.surface->distance(point);
      // Differences of heights over 1e-3 mm are right to some 1e-10.
      EXPECT_NEAR(found.mm, mm, 1e-7);
      EXPECT_LT((found.normal - normal).norm(), 1e-8);
    }
  }
}

TEST(TargetSurface, ScalesItsCurvature) {
  for (const Described& sampled : described()) {
    const double whole = sampled.surface->curvature_per_mm();
    EXPECT_GT(whole, 0);
    EXPECT_NEAR(sampled.surface->scaled(0.25)->curvature_per_mm(), whole / 4, 1e-12);
    const Vector3d point(30, -50, 7);
    EXPECT_NEAR(sampled.surface->scaled(0)->distance(point).mm, 7, 1e-12);
    const double far_mm = std::abs(sampled.surface->distance(point).mm - 7),
                 half_mm = std::abs(sampled.surface->scaled(0.5)->distance(point).mm - 7);
    EXPECT_GT(far_mm, half_mm);
  }
}

}  // namespace
}  // namespace misalign::solver
