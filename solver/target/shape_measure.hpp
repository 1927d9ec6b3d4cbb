// The distances of folded sheets from one wanted shape, each sheet in its best pose.
#pragma once

#include <optional>

#include "solver/sheet/sheet.hpp"
#include "solver/target/shape_fit.hpp"

namespace misalign::solver {

/// A wanted shape with its rows, which the base of the sheets has, at one pilot angle.
class ShapeMeasure {
 public:
  /// None where the base that is not shifted does not fold to this angle.
  static std::optional<ShapeMeasure> of(SheetSolver& solver, const WantedShape& wanted,
                                        double at_deg);

  double at_deg() const { return at_deg_; }
  const ShapeTarget& target() const { return target_; }
  /// The pose of least squares for folded vertices, placed anywhere; and their misfit in it.
  ShapePose pose(const Eigen::Matrix3Xd& vertices_mm) const;
  ShapeMisfit fitted(const Eigen::Matrix3Xd& vertices_mm) const;
  /// The same of a sheet; none where it does not fold to the angle.
  std::optional<ShapeMisfit> fitted(const Sheet& sheet) const;

 private:
  ShapeMeasure(ShapeTarget target, double at_deg, const ShapePose& pose,
               const Eigen::Matrix3Xd& base_mm);

  ShapeTarget target_;
  double at_deg_;
  Eigen::Matrix3Xd base_mm_;  // the folded base on the plane or the places, near which poses begin
  double half_depth_mm_;
};

/// The misfit of one sheet. None where it, or its base, does not fold to the angle.
std::optional<ShapeMisfit> shape_misfit_of(const Sheet& sheet, const WantedShape& wanted,
                                           double at_deg);

}  // namespace misalign::solver
