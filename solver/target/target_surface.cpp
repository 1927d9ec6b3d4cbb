#include "solver/target/target_surface.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Newton steps to a foot, and the last step's length beside the point's distance from the origin.
constexpr int kMostFootSteps = 40;
constexpr double kLastFootStep = 1e-14;
// Curvatures of a grid are estimated at this many places along each side.
constexpr int kPlaces = 24;

using Height = HeightField::Height;

class Plane final : public TargetSurface {
 public:
  SurfaceDistance distance(const Vector3d& point_mm) const override {
    return {point_mm.z(), Vector3d::UnitZ()};
  }
  std::unique_ptr<TargetSurface> scaled(double) const override { return std::make_unique<Plane>(); }
  double curvature_per_mm() const override { return 0; }
};

// A sphere, or a cylinder along one axis: the points with one distance from a centre, in the
// directions that count.
class Round final : public TargetSurface {
 public:
  Round(double radius_mm, const Vector3d& counts) : radius_mm_(radius_mm), counts_(counts) {
    assert(radius_mm != 0);
  }

  SurfaceDistance distance(const Vector3d& point_mm) const override {
    const Vector3d from_centre_mm =
        (point_mm + radius_mm_ * Vector3d::UnitZ()).cwiseProduct(counts_);
    const double side = radius_mm_ < 0 ? -1 : 1, away_mm = from_centre_mm.norm();
    return {side * (away_mm - std::abs(radius_mm_)), side / away_mm * from_centre_mm};
  }
  std::unique_ptr<TargetSurface> scaled(double share) const override {
    if (share == 0) return std::make_unique<Plane>();
    return std::make_unique<Round>(radius_mm_ / share, counts_);
  }
  double curvature_per_mm() const override { return 1 / std::abs(radius_mm_); }

 private:
  double radius_mm_;
  Vector3d counts_;
};

// A height by a formula, whose curvature at the origin is its only number.
class Formula final : public HeightField {
 public:
  using Function = Height (*)(double per_mm, double x, double y);
  Formula(double per_mm, Function height) : per_mm_(per_mm), height_(height) {}
  std::unique_ptr<TargetSurface> scaled(double share) const override {
    return std::make_unique<Formula>(share * per_mm_, height_);
  }
  double curvature_per_mm() const override { return std::abs(per_mm_); }

 private:
  Height at(const Vector2d& place_mm) const override {
    return height_(per_mm_, place_mm.x(), place_mm.y());
  }
  double per_mm_;
  Function height_;
};

Height saddle_height(double per_mm, double x, double y) {
  return {per_mm / 2 * (x * x - y * y),
          {per_mm * x, -per_mm * y},
          Vector2d(per_mm, -per_mm).asDiagonal()};
}

Height helicoid_height(double per_mm, double x, double y) {
  const auto half = half_angle_of_rad(std::remainder(per_mm * y, kPi));
  const double tangent = 2 * half.s * half.c / (half.c * half.c - half.s * half.s),
               rate = per_mm * (1 + tangent * tangent);
  Matrix2d bend;
  bend << 0, rate, rate, 2 * per_mm * tangent * rate * x;
  return {x * tangent, {tangent, x * rate}, bend};
}

class HeightGrid final : public HeightField {
 public:
  HeightGrid(double spacing_mm, MatrixXd heights_mm)
      : spacing_mm_(spacing_mm), heights_mm_(std::move(heights_mm)) {
    assert(spacing_mm > 0 && heights_mm_.rows() >= 2 && heights_mm_.cols() >= 2);
  }
  std::unique_ptr<TargetSurface> scaled(double share) const override {
    return std::make_unique<HeightGrid>(spacing_mm_, share * heights_mm_);
  }
  double curvature_per_mm() const override {
    double most = 0;
    for (int i = 0; i <= kPlaces; ++i) {
      for (int k = 0; k <= kPlaces; ++k) {
        const Vector2d share(static_cast<double>(i) / kPlaces - 0.5,
                             static_cast<double>(k) / kPlaces - 0.5);
        most = std::max(most, at(share.cwiseProduct(size_mm())).bend_per_mm.norm());
      }
    }
    return most;
  }

 private:
  Vector2d size_mm() const {
    return spacing_mm_ * Vector2d(static_cast<double>(heights_mm_.cols() - 1),
                                  static_cast<double>(heights_mm_.rows() - 1));
  }

  // Height of a node; beyond the rim it goes on straight.
  double node_mm(Index row, Index column) const {
    const auto beyond = [](Index at, Index count) {
      return at < 0 ? std::pair(Index{0}, at)
                    : std::pair(std::min(at, count - 1), std::max(at - count + 1, Index{0}));
    };
    const auto [r, over_r] = beyond(row, heights_mm_.rows());
    const auto [c, over_c] = beyond(column, heights_mm_.cols());
    double mm = heights_mm_(r, c);
    const Index in_r = over_r < 0 ? 1 : r - 1, in_c = over_c < 0 ? 1 : c - 1;
    if (over_r != 0)
      mm += std::abs(static_cast<double>(over_r)) * (heights_mm_(r, c) - heights_mm_(in_r, c));
    if (over_c != 0)
      mm += std::abs(static_cast<double>(over_c)) * (heights_mm_(r, c) - heights_mm_(r, in_c));
    return mm;
  }

  // Weights of four nodes for the value and its first two derivatives at a share of the way from
  // the second to the third.
  static std::array<Eigen::Vector4d, 3> weights(double t) {
    const double tt = t * t, ttt = tt * t;
    return {
        Eigen::Vector4d(-ttt + 2 * tt - t, 3 * ttt - 5 * tt + 2, -3 * ttt + 4 * tt + t, ttt - tt) /
            2,
        Eigen::Vector4d(-3 * tt + 4 * t - 1, 9 * tt - 10 * t, -9 * tt + 8 * t + 1, 3 * tt - 2 * t) /
            2,
        Eigen::Vector4d(-6 * t + 4, 18 * t - 10, -18 * t + 8, 6 * t - 2) / 2};
  }

  Height at(const Vector2d& place_mm) const override {
    const Vector2d at = (place_mm + size_mm() / 2) / spacing_mm_, cell = at.array().floor();
    const auto by_x = weights(at.x() - cell.x()), by_y = weights(at.y() - cell.y());
    Eigen::Matrix4d nodes_mm;
    for (Index i = 0; i < 4; ++i) {
      for (Index k = 0; k < 4; ++k) {
        nodes_mm(i, k) =
            node_mm(static_cast<Index>(cell.y()) + i - 1, static_cast<Index>(cell.x()) + k - 1);
      }
    }
    const auto sum = [&](int y, int x) { return by_y[y].dot(nodes_mm * by_x[x]); };
    Matrix2d bend;
    bend << sum(0, 2), sum(1, 1), sum(1, 1), sum(2, 0);
    return {sum(0, 0), Vector2d(sum(0, 1), sum(1, 0)) / spacing_mm_,
            bend / (spacing_mm_ * spacing_mm_)};
  }

  double spacing_mm_;
  MatrixXd heights_mm_;
};

}  // namespace

SurfaceDistance HeightField::distance(const Vector3d& point_mm) const {
  Vector2d foot = point_mm.head<2>();
  for (int step = 0; step < kMostFootSteps; ++step) {
    const Height height = at(foot);
    const double above_mm = height.mm - point_mm.z();
    const Vector2d gradient = foot - point_mm.head<2>() + above_mm * height.slope;
    const Matrix2d squares = Matrix2d::Identity() + height.slope * height.slope.transpose();
    const Matrix2d hessian = squares + above_mm * height.bend_per_mm;
    // Beyond a centre of curvature the Hessian of the distance is not positive definite.
    const bool is_positive = hessian(0, 0) > 0 && hessian.determinant() > 0;
    const Vector2d change = (is_positive ? hessian : squares).inverse() * gradient;
    foot -= change;
    if (change.norm() <= kLastFootStep * (1 + foot.norm())) break;
  }
  const Height height = at(foot);
  const Vector3d normal = Vector3d(-height.slope.x(), -height.slope.y(), 1).normalized();
  return {normal.dot(point_mm - Vector3d(foot.x(), foot.y(), height.mm)), normal};
}

std::unique_ptr<TargetSurface> plane() { return std::make_unique<Plane>(); }

std::unique_ptr<TargetSurface> cylinder(double radius_mm, bool along_x) {
  return std::make_unique<Round>(radius_mm, along_x ? Vector3d(0, 1, 1) : Vector3d(1, 0, 1));
}

std::unique_ptr<TargetSurface> sphere(double radius_mm) {
  return std::make_unique<Round>(radius_mm, Vector3d::Ones());
}

std::unique_ptr<TargetSurface> saddle(double radius_mm) {
  assert(radius_mm != 0);
  return std::make_unique<Formula>(1 / radius_mm, saddle_height);
}

std::unique_ptr<TargetSurface> helicoid(double radius_mm) {
  assert(radius_mm != 0);
  return std::make_unique<Formula>(1 / radius_mm, helicoid_height);
}

std::unique_ptr<TargetSurface> height_grid(double spacing_mm, const MatrixXd& heights_mm) {
  return std::make_unique<HeightGrid>(spacing_mm, heights_mm);
}

}  // namespace misalign::solver
