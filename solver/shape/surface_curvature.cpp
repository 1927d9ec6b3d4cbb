#include "solver/shape/surface_curvature.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Matrix3Xd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Share of the largest pivot below which a coefficient is not determined: three rows of vertices
// have their levels where a parabola has its heights.
constexpr double kDetermined = 0.05;

// Fits until feet stay: a change shrinks by (half depth * curvature), a few hundredths, each time.
constexpr int kFits = 8;

// Root mean square of distances over that of places beyond which the sheet is no quadric: rolled
// up.
constexpr double kMostRms = 0.05;

// Height, slope by x and y, bend by xx, xy and yy.
using HeightQuadric = Eigen::Matrix<double, 6, 1>;

Matrix2d bend_of(const HeightQuadric& quadric) {
  Matrix2d bend;
  bend << quadric(3), quadric(4), quadric(4), quadric(5);
  return bend;
}

struct LevelFit {
  HeightQuadric quadric = HeightQuadric::Zero();
  double half_depth = 0, rms = 0;
};

// Fits a quadric to the feet of places at the half depth along its normals, and the half depth;
// zero where all are on one level.
std::optional<LevelFit> fitted_levels(const Matrix3Xd& places, const VectorXd& sides) {
  LevelFit fit;
  Matrix3Xd feet = places;
  const bool has_levels = sides.minCoeff() < sides.maxCoeff();
  for (int time = 0; time < kFits; ++time) {
    Eigen::MatrixXd rows(places.cols(), has_levels ? 7 : 6);
    for (Index k = 0; k < places.cols(); ++k) {
      const Vector2d slope =
          fit.quadric.segment<2>(1) + bend_of(fit.quadric) * feet.col(k).head<2>();
      feet.col(k) = places.col(k) -
                    sides(k) * fit.half_depth * Vector3d(-slope.x(), -slope.y(), 1).normalized();
      const double x = feet(0, k), y = feet(1, k);
      rows.row(k).head<6>() << 1, x, y, x * x / 2, x * y, y * y / 2;
      if (has_levels) rows(k, 6) = sides(k);
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows);
    qr.setThreshold(kDetermined);
    if (qr.rank() < rows.cols()) return std::nullopt;
    const VectorXd heights = feet.row(2).transpose(), found = qr.solve(heights);
    fit.quadric = found.head<6>();
    if (has_levels) fit.half_depth += found(6);
    fit.rms = (rows * found - heights).norm() / std::sqrt(static_cast<double>(places.cols()));
  }
  if (fit.rms > kMostRms) return std::nullopt;
  return fit;
}

}  // namespace

std::optional<SurfaceCurvature> surface_curvature(const Matrix3Xd& vertices_mm,
                                                  const VectorXd& sides, const Vector3d& up) {
  assert(vertices_mm.cols() == sides.size());
  std::vector<Index> inner;
  for (Index v = 0; v < sides.size(); ++v) {
    if (sides(v) != 0) inner.push_back(v);
  }
  if (inner.size() < 7) return std::nullopt;
  const Matrix3Xd chosen_mm = vertices_mm(Eigen::all, inner);
  const Matrix3Xd from_middle_mm = chosen_mm.colwise() - chosen_mm.rowwise().mean().eval();
  const Eigen::JacobiSVD<Matrix3Xd> svd(from_middle_mm, Eigen::ComputeFullU);
  Eigen::Matrix3d frame = svd.matrixU();
  if (frame.col(2).dot(up) < 0) frame.col(2) *= -1;
  const double size_mm = from_middle_mm.norm() / std::sqrt(static_cast<double>(inner.size()));
  const auto fit = fitted_levels(frame.transpose() * from_middle_mm / size_mm, sides(inner));
  if (!fit) return std::nullopt;

  const Vector2d slope = fit->quadric.segment<2>(1);
  const Matrix2d metric = Matrix2d::Identity() + slope * slope.transpose();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix2d> principal(
      -bend_of(fit->quadric) / (size_mm * std::sqrt(1 + slope.squaredNorm())), metric);
  Vector2d curvatures_per_mm = principal.eigenvalues();
  Matrix2d directions = principal.eigenvectors();
  if (std::abs(curvatures_per_mm(0)) < std::abs(curvatures_per_mm(1))) {
    curvatures_per_mm.reverseInPlace();
    directions.col(0).swap(directions.col(1));
  }
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << directions, slope.transpose() * directions;
  return SurfaceCurvature{{curvatures_per_mm(0), curvatures_per_mm(1)},
                          (frame * tangents).colwise().normalized(),
                          size_mm * fit->half_depth,
                          size_mm * fit->rms};
}

VectorXd level_sides(const PerforatedSheet& base) {
  VectorXd sides = VectorXd::Zero(base.sheet.vertex_count());
  for (std::size_t e = 0; e < base.sheet.edges.size(); ++e) {
    const int valley = base.folding.side() * base.folding.assignment()[e];
    for (const int v : {base.sheet.edges[e].a, base.sheet.edges[e].b}) sides(v) -= valley;
  }
  VectorXd inner = VectorXd::Zero(sides.size());
  for (const int v : interior_vertices(base.sheet)) inner(v) = sides(v) < 0 ? -1 : 1;
  return inner;
}

std::optional<SurfaceCurvature> surface_curvature(const Sheet& sheet, double pilot_deg) {
  if (!sheet.way() || sheet.way()->end_deg() < pilot_deg) return std::nullopt;
  const Matrix3Xd& vertices_mm = sheet.at(pilot_deg).vertices_mm;
  Vector3d up = Vector3d::Zero();  // areas seen from +z
  for (const auto& corners : sheet.base().sheet.facets) {
    const auto diagonal_mm = [&](std::size_t k) -> Vector3d {
      return vertices_mm.col(corners[k + 2]) - vertices_mm.col(corners[k]);
    };
    up += diagonal_mm(0).cross(diagonal_mm(1));
  }
  return surface_curvature(vertices_mm, level_sides(sheet.base()), up);
}

}  // namespace misalign::solver
