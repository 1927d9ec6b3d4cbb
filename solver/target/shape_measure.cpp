#include "solver/target/shape_measure.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <utility>

namespace misalign::solver {

using Eigen::Matrix3Xd;

std::optional<ShapeMeasure> ShapeMeasure::of(SheetSolver& solver, const WantedShape& wanted,
                                             double at_deg) {
  assert(at_deg > 0);
  const PerforatedSheet& base = solver.model().base();
  const Sheet flat(solver, Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count()));
  if (!flat.way() || flat.way()->end_deg() <= at_deg) return {};
  const Matrix3Xd& folded_mm = flat.at(at_deg).vertices_mm;
  ShapeTarget target{wanted, {}, {}, {}};
  const ShapePose pose = lay_base(base, folded_mm, target);
  target.surface = wanted.surface;  // the base lies on a plane
  return ShapeMeasure(std::move(target), at_deg, pose, pose.placed(folded_mm));
}

ShapeMeasure::ShapeMeasure(ShapeTarget target, double at_deg, const ShapePose& pose,
                           const Matrix3Xd& base_mm)
    : target_(std::move(target)),
      at_deg_(at_deg),
      base_mm_(base_mm),
      half_depth_mm_(pose.half_depth_mm) {}

ShapePose ShapeMeasure::pose(const Matrix3Xd& vertices_mm) const {
  const Eigen::Matrix4d motion = Eigen::umeyama(vertices_mm, base_mm_, false);
  const ShapePose near{motion.topLeftCorner<3, 3>(), motion.topRightCorner<3, 1>(), half_depth_mm_};
  return fitted_pose(target_, vertices_mm, near);
}

ShapeMisfit ShapeMeasure::fitted(const Matrix3Xd& vertices_mm) const {
  return misfit(target_, vertices_mm, pose(vertices_mm));
}

std::optional<ShapeMisfit> ShapeMeasure::fitted(const Sheet& sheet) const {
  if (!sheet.way() || sheet.way()->end_deg() <= at_deg_) return {};
  const Sheet::Pose& pose = sheet.at(at_deg_);
  return pose.is_closed ? std::optional(fitted(pose.vertices_mm)) : std::nullopt;
}

std::optional<ShapeMisfit> shape_misfit_of(const Sheet& sheet, const WantedShape& wanted,
                                           double at_deg) {
  SheetSolver solver(sheet.model());
  const auto measure = ShapeMeasure::of(solver, wanted, at_deg);
  return measure ? measure->fitted(sheet) : std::nullopt;
}

}  // namespace misalign::solver
