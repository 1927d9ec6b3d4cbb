#include "solver/target/shape_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cassert>
#include <cmath>

#include "solver/pattern/outline.hpp"

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

ShapeMisfit surface_misfit(const ShapeTarget& target, const Matrix3Xd& vertices_mm,
                           const ShapePose& pose) {
  const Index count = target.weights.rows(), vertices = vertices_mm.cols();
  assert(target.sides.size() == count && target.flat_mm.cols() == vertices);
  ShapeMisfit found{count, VectorXd(count + 3), Eigen::MatrixXd(count + 3, 7), Matrix3Xd(3, count),
                    Eigen::MatrixXd(3, 3 * vertices)};
  const Matrix3Xd rows_mm = vertices_mm * target.weights.transpose();
  for (Index k = 0; k < count; ++k) {
    const Vector3d placed_mm = pose.turn * rows_mm.col(k) + pose.move_mm;
    const SurfaceDistance away = target.surface->distance(placed_mm);
    found.mm(k) = away.mm - target.sides(k) * pose.half_depth_mm;
    found.by_pose.row(k) << placed_mm.cross(away.normal).transpose(), away.normal.transpose(),
        -target.sides(k);
    found.by_mm.col(k) = pose.turn.transpose() * away.normal;
  }
  found.mm.tail<3>().setZero();
  found.by_pose.bottomRows<3>().setZero();
  const double each = kHold * std::sqrt(static_cast<double>(count)) / static_cast<double>(vertices),
               arc = std::sqrt(static_cast<double>(vertices) / target.flat_mm.squaredNorm());
  for (Index v = 0; v < vertices; ++v) {
    const Vector3d placed_mm = pose.turn * vertices_mm.col(v) + pose.move_mm;
    // Each hold is a sum over the vertices of an axis times the place.
    const Eigen::Vector2d flat_mm = target.flat_mm.col(v);
    const Vector3d axes[3] = {each * Vector3d::UnitX(), each * Vector3d::UnitY(),
                              each * arc * Vector3d(-flat_mm.y(), flat_mm.x(), 0)};
    for (Index k = 0; k < 3; ++k) {
      found.mm(count + k) += axes[k].dot(placed_mm);
      found.by_pose.row(count + k).head<3>() += placed_mm.cross(axes[k]).transpose();
      found.by_pose.row(count + k).segment<3>(3) += axes[k].transpose();
      found.hold_by_mm.row(k).segment<3>(3 * v) = axes[k].transpose() * pose.turn;
    }
  }
  return found;
}

ShapeMisfit place_misfit(const ShapeTarget& target, const Matrix3Xd& vertices_mm,
                         const ShapePose& pose) {
  const Index count = 3 * std::ssize(target.places);
  ShapeMisfit found{count, VectorXd(count), Eigen::MatrixXd::Zero(count, 7), Matrix3Xd(3, count),
                    Eigen::MatrixXd(0, 3 * vertices_mm.cols())};
  for (Index k = 0; k < count; ++k) {
    const WantedShape::Place& place = target.places[static_cast<std::size_t>(k / 3)];
    const Vector3d placed_mm = pose.turn * vertices_mm.col(place.vertex) + pose.move_mm;
    const Vector3d axis = Vector3d::Unit(k % 3);
    found.mm(k) = placed_mm(k % 3) - place.mm(k % 3);
    found.by_pose.row(k).head<6>() << placed_mm.cross(axis).transpose(), axis.transpose();
    found.by_mm.col(k) = pose.turn.transpose() * axis;
  }
  return found;
}

// Weights of the vertices in each row that is measured.
Eigen::MatrixXd weights_of(const WantedShape& shape, const PerforatedSheet& base) {
  const Index vertices = base.sheet.vertex_count();
  if (!shape.surface) {
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(3 * std::ssize(shape.places), vertices);
    for (Index k = 0; k < weights.rows(); ++k) {
      weights(k, shape.places[static_cast<std::size_t>(k / 3)].vertex) = 1;
    }
    return weights;
  }
  if (shape.measured == WantedShape::Measured::vertices)
    return Eigen::MatrixXd::Identity(vertices, vertices);
  const std::vector<int> panels = kept_facets(base.sheet, base.holes);
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(std::ssize(panels), vertices);
  for (Index k = 0; k < weights.rows(); ++k) {
    const int panel = panels[static_cast<std::size_t>(k)];
    for (const int v : base.sheet.facets[static_cast<std::size_t>(panel)]) weights(k, v) = 0.25;
  }
  return weights;
}

// The pose on places that fits best.
ShapePose pose_on_places(const WantedShape& shape, const Matrix3Xd& folded_mm) {
  Matrix3Xd from_mm(3, std::ssize(shape.places)), to_mm = from_mm;
  for (Index k = 0; k < from_mm.cols(); ++k) {
    const WantedShape::Place& place = shape.places[static_cast<std::size_t>(k)];
    from_mm.col(k) = folded_mm.col(place.vertex);
    to_mm.col(k) = place.mm;
  }
  const Eigen::Matrix4d motion = Eigen::umeyama(from_mm, to_mm, false);
  return {motion.topLeftCorner<3, 3>(), motion.topRightCorner<3, 1>(), 0};
}

}  // namespace

ShapePose ShapePose::after(const Change& change) const {
  const Eigen::Matrix3d more =
      Eigen::Quaterniond(1, change(0) / 2, change(1) / 2, change(2) / 2).normalized().matrix();
  return {more * turn, more * move_mm + change.segment<3>(3), half_depth_mm + change(6)};
}

VectorXd ShapeMisfit::distances_mm() const {
  const auto all_mm = mm.head(measured);
  if (hold_by_mm.rows() > 0) return all_mm.cwiseAbs();
  return all_mm.reshaped(3, measured / 3).colwise().norm();
}

double ShapeMisfit::rms_mm() const {
  const VectorXd each_mm = distances_mm();
  return each_mm.norm() / std::sqrt(static_cast<double>(each_mm.size()));
}

ShapeMisfit misfit(const ShapeTarget& target, const Matrix3Xd& vertices_mm, const ShapePose& pose) {
  return target.surface ? surface_misfit(target, vertices_mm, pose)
                        : place_misfit(target, vertices_mm, pose);
}

Eigen::MatrixXd misfit_by(const ShapeMisfit& misfit, const Eigen::MatrixXd& weights,
                          const Eigen::MatrixXd& vertices_by) {
  assert(vertices_by.rows() == 3 * weights.cols());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(misfit.mm.size(), vertices_by.cols());
  for (Index k = 0; k < misfit.measured; ++k) {
    for (Index v = 0; v < weights.cols(); ++v) {
      if (weights(k, v) == 0) continue;
      slopes.row(k) +=
          weights(k, v) * misfit.by_mm.col(k).transpose() * vertices_by.middleRows(3 * v, 3);
    }
  }
  // Entry by entry: Eigen splits longer sums of a product by the processor's cache.
  slopes.bottomRows(misfit.hold_by_mm.rows()) = misfit.hold_by_mm.lazyProduct(vertices_by);
  return slopes;
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

ShapePose lay_base(const PerforatedSheet& base, const Matrix3Xd& folded_mm, ShapeTarget& target) {
  const Eigen::Matrix2Xd& flat_mm = base.sheet.vertices_mm;
  target.flat_mm = flat_mm.colwise() - flat_mm.rowwise().mean().eval();
  const Eigen::MatrixXd weights = weights_of(target, base);
  if (!target.surface) {
    target.weights = weights;
    return pose_on_places(target, folded_mm);
  }
  const std::vector<int> inner = interior_vertices(base.sheet);
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
  // The levels are those of the inner vertices alone.
  target.weights = Eigen::MatrixXd::Zero(std::ssize(inner), flat_mm.cols());
  for (std::size_t k = 0; k < inner.size(); ++k) {
    target.weights(static_cast<Index>(k), inner[k]) = 1;
  }
  target.sides = pose.placed(inner_mm).row(2).cwiseSign();
  pose.half_depth_mm = pose.placed(inner_mm).row(2).cwiseAbs().mean();
  pose = fitted_pose(target, folded_mm, pose);
  VectorXd sides = pose.placed(folded_mm).row(2).transpose() / pose.half_depth_mm;
  for (std::size_t k = 0; k < inner.size(); ++k) {
    sides(inner[k]) = target.sides(static_cast<Index>(k));
  }
  target.weights = weights;
  target.sides = weights * sides;
  return fitted_pose(target, folded_mm, pose);
}

}  // namespace misalign::solver
