// Places a folded sheet on a target surface, its vertices on the two surfaces at half the fold's
// depth above and below it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solver/shape/target_surface.hpp"

namespace misalign::solver {

/// A rigid motion into the target's frame, and half the depth of the fold.
struct ShapePose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d move_mm = Eigen::Vector3d::Zero();
  double half_depth_mm = 0;

  Eigen::Matrix3Xd placed(const Eigen::Matrix3Xd& vertices_mm) const {
    return (turn * vertices_mm).colwise() + move_mm;
  }
  /// The pose after a turn by `change`(0..2) rad about the origin of the target's frame, a move by
  /// (3..5) mm and a change of the half depth by (6) mm.
  ShapePose after(const Eigen::Matrix<double, 7, 1>& change) const;
};

/// A target, and how a sheet lies on it.
struct ShapeTarget {
  std::shared_ptr<const TargetSurface> surface;
  Eigen::VectorXd sides;     ///< per vertex: 1 above the surface, -1 below
  Eigen::Matrix2Xd flat_mm;  ///< the flat base with its middle at zero, for the turn about z
};

/// Distances of the vertices from their surfaces; and then what holds the sheet's place on the
/// target, where it would slide to where a saddle is flat: the middle's x and y, and the turn about
/// z as an arc of the sheet's size, weighted. Derivatives are by the pose's change, and by the
/// vertex in the sheet's frame.
struct ShapeMisfit {
  Eigen::VectorXd mm;          ///< vertices + 3
  Eigen::MatrixXd by_pose;     ///< (vertices + 3) x 7
  Eigen::Matrix3Xd by_mm;      ///< per vertex, of its own distance
  Eigen::MatrixXd hold_by_mm;  ///< 3 x (3 vertices)

  Eigen::Index vertices() const { return by_mm.cols(); }
  double rms_mm() const;
  double max_mm() const { return mm.head(vertices()).cwiseAbs().maxCoeff(); }
};

ShapeMisfit misfit(const ShapeTarget& target, const Eigen::Matrix3Xd& vertices_mm,
                   const ShapePose& pose);

/// Lays the folded base on z = 0, in the middle between its two levels, and sets the target's sides
/// and flat places. `inner` vertices lie on the levels, 1 and -1; the others, where a rim cuts
/// panels, between them or beyond.
ShapePose lay_base(const Eigen::Matrix2Xd& flat_mm, const Eigen::Matrix3Xd& folded_mm,
                   const std::vector<int>& inner, ShapeTarget& target);
/// The pose with the least squares of the misfit, from one nearby.
ShapePose fitted_pose(const ShapeTarget& target, const Eigen::Matrix3Xd& vertices_mm,
                      ShapePose pose);

}  // namespace misalign::solver
