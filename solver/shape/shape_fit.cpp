#include "solver/shape/shape_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Change = Eigen::Matrix<double, 7, 1>;

// Steps of a fit, and the change of its squares, as a share, that ends it.
constexpr int kMostTries = 60;
constexpr double kLastShare = 1e-13;
// Weight of the middle's place and of the turn about z, beside a vertex's distance.
constexpr double kHold = 1;
// Damping of steps that a surface leaves free, such as turns on a sphere.
constexpr double kDamping = 1e-6;

}  // namespace

ShapePose ShapePose::after(const Change& change) const {
  const Vector3d about = change.head<3>();
  const double angle = about.norm();
  const Eigen::Matrix3d more = angle > 0
                                   ? Eigen::AngleAxisd(angle, about / angle).toRotationMatrix()
                                   : Eigen::Matrix3d::Identity();
  return {more * turn, more * move_mm + change.segment<3>(3), half_depth_mm + change(6)};
}

double ShapeMisfit::rms_mm() const {
  return mm.head(vertices()).norm() / std::sqrt(static_cast<double>(vertices()));
}

ShapeMisfit misfit(const ShapeTarget& target, const Matrix3Xd& vertices_mm, const ShapePose& pose) {
  const Index count = vertices_mm.cols();
  assert(target.sides.size() == count && target.flat_mm.cols() == count);
  ShapeMisfit found{VectorXd(count + 3), Eigen::MatrixXd(count + 3, 7), Matrix3Xd(3, count),
                    Eigen::MatrixXd(3, 3 * count)};
  const auto n = static_cast<double>(count);
  const double arc = std::sqrt(n / target.flat_mm.squaredNorm()) * kHold;
  found.mm.tail<3>().setZero();
  found.by_pose.bottomRows<3>().setZero();
  for (Index v = 0; v < count; ++v) {
    const Vector3d placed_mm = pose.turn * vertices_mm.col(v) + pose.move_mm;
    const SurfaceDistance away = target.surface->distance(placed_mm);
    found.mm(v) = away.mm - target.sides(v) * pose.half_depth_mm;
    found.by_pose.row(v) << placed_mm.cross(away.normal).transpose(), away.normal.transpose(),
        -target.sides(v);
    found.by_mm.col(v) = pose.turn.transpose() * away.normal;
    // Each hold is a sum over the vertices of an axis times the place.
    const Eigen::Vector2d flat_mm = target.flat_mm.col(v);
    const Vector3d axes[3] = {kHold / std::sqrt(n) * Vector3d::UnitX(),
                              kHold / std::sqrt(n) * Vector3d::UnitY(),
                              arc / std::sqrt(n) * Vector3d(-flat_mm.y(), flat_mm.x(), 0)};
    for (Index k = 0; k < 3; ++k) {
      found.mm(count + k) += axes[k].dot(placed_mm);
      found.by_pose.row(count + k).head<3>() += placed_mm.cross(axes[k]).transpose();
      found.by_pose.row(count + k).segment<3>(3) += axes[k].transpose();
      found.hold_by_mm.row(k).segment<3>(3 * v) = axes[k].transpose() * pose.turn;
    }
  }
  return found;
}

ShapePose fitted_pose(const ShapeTarget& target, const Matrix3Xd& vertices_mm, ShapePose pose) {
  ShapeMisfit now = misfit(target, vertices_mm, pose);
  for (int step = 0; step < kMostTries; ++step) {
    Eigen::Matrix<double, 7, 7> squares = now.by_pose.transpose() * now.by_pose;
    squares.diagonal() *= 1 + kDamping * kDamping;
    const ShapePose next = pose.after(-squares.ldlt().solve(now.by_pose.transpose() * now.mm));
    ShapeMisfit there = misfit(target, vertices_mm, next);
    const double gain = now.mm.squaredNorm() - there.mm.squaredNorm();
    if (gain <= 0) break;
    pose = next;
    const bool is_last = gain <= kLastShare * now.mm.squaredNorm();
    now = std::move(there);
    if (is_last) break;
  }
  return pose;
}

ShapePose lay_base(const Eigen::Matrix2Xd& flat_mm, const Matrix3Xd& folded_mm,
                   const std::vector<int>& inner, ShapeTarget& target) {
  const Matrix3Xd inner_mm = folded_mm(Eigen::all, inner);
  const Vector3d middle_mm = inner_mm.rowwise().mean();
  const Eigen::JacobiSVD<Matrix3Xd> svd(inner_mm.colwise() - middle_mm, Eigen::ComputeFullU);
  Vector3d normal = svd.matrixU().col(2);
  if (normal.z() < 0) normal = -normal;
  const Vector3d x = (Vector3d::UnitX() - normal.x() * normal).normalized();
  ShapePose pose;
  pose.turn << x.transpose(), normal.cross(x).transpose(), normal.transpose();
  pose.move_mm = -pose.turn * middle_mm;
  target.surface = plane();
  const Eigen::Matrix2Xd inner_flat_mm = flat_mm(Eigen::all, inner);
  target.flat_mm = inner_flat_mm.colwise() - inner_flat_mm.rowwise().mean().eval();
  target.sides = pose.placed(inner_mm).row(2).cwiseSign();
  pose.half_depth_mm = pose.placed(inner_mm).row(2).cwiseAbs().mean();
  pose = fitted_pose(target, inner_mm, pose);
  VectorXd sides = pose.placed(folded_mm).row(2).transpose() / pose.half_depth_mm;
  for (std::size_t k = 0; k < inner.size(); ++k) {
    sides(inner[k]) = target.sides(static_cast<Index>(k));
  }
  target.sides = sides;
  target.flat_mm = flat_mm.colwise() - flat_mm.rowwise().mean().eval();
  return fitted_pose(target, folded_mm, pose);
}

}  // namespace misalign::solver
