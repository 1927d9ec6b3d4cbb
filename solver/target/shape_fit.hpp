// Places a folded sheet on a target surface, its vertices on the two surfaces at half the fold's
// depth above and below it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "solver/pattern/perforation.hpp"
#include "solver/target/target_surface.hpp"

namespace misalign::solver {

/// A rigid motion into the target's frame, and half the depth of the fold.
struct ShapePose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d move_mm = Eigen::Vector3d::Zero();
  double half_depth_mm = 0;

  Eigen::Matrix3Xd placed(const Eigen::Matrix3Xd& vertices_mm) const {
    return (turn * vertices_mm).colwise() + move_mm;
  }
  /// The pose after a turn by `change`(0..2) rad about the origin of the target's frame, to second
  /// order, a move by (3..5) mm and a change of the half depth by (6) mm.
  ShapePose after(const Eigen::Matrix<double, 7, 1>& change) const;
};

/// The shape of a folded sheet: a surface, for its vertices or for the middles of its panels, or
/// places of single vertices.
struct WantedShape {
  std::shared_ptr<const TargetSurface> surface;  ///< null where places are given
  enum class Measured { vertices, panels } measured = Measured::vertices;
  struct Place {
    int vertex;
    Eigen::Vector3d mm;
  };
  std::vector<Place> places;  ///< three or more, not on one line
};

/// A wanted shape, and how a sheet lies on it.
struct ShapeTarget : WantedShape {
  /// Weights of the vertices in what is measured: a row per vertex, per panel or per place.
  Eigen::MatrixXd weights;
  Eigen::VectorXd sides;     ///< per row: 1 above the surface, -1 below, 0 a panel's middle
  Eigen::Matrix2Xd flat_mm;  ///< the flat base with its middle at zero, for the turn about z
};

/// Distances of a sheet from its target: of each row from its surface, or along x, y and z from its
/// place; and, on a surface, what holds the sheet there, where it would slide to where a saddle is
/// flat: the middle's x and y, and the turn about z as an arc of the sheet's size, weighted.
/// Derivatives are by the pose's change, and by the place in the sheet's frame.
struct ShapeMisfit {
  Eigen::Index measured;       ///< distances; holds follow
  Eigen::VectorXd mm;          ///< measured + 3 on a surface, 3 x places otherwise
  Eigen::MatrixXd by_pose;     ///< (entries of mm) x 7
  Eigen::Matrix3Xd by_mm;      ///< per distance, of its own row
  Eigen::MatrixXd hold_by_mm;  ///< holds x (3 vertices)

  Eigen::VectorXd distances_mm() const;  ///< per row, not negative
  double rms_mm() const;
  double max_mm() const { return distances_mm().maxCoeff(); }
};

ShapeMisfit misfit(const ShapeTarget& target, const Eigen::Matrix3Xd& vertices_mm,
                   const ShapePose& pose);

/// Derivatives of the misfit's entries by coordinates by which those of the vertices are given, (3
/// vertices) x coordinates; the pose is held. `weights` are the target's.
Eigen::MatrixXd misfit_by(const ShapeMisfit& misfit, const Eigen::MatrixXd& weights,
                          const Eigen::MatrixXd& vertices_by);

/// Lays the folded base on the plane z = 0, in the middle between its two levels, or on the places,
/// and makes the target's rows. Inner vertices lie on the levels, 1 and -1; the others, where a rim
/// cuts panels, between them or beyond.
ShapePose lay_base(const PerforatedSheet& base, const Eigen::Matrix3Xd& folded_mm,
                   ShapeTarget& target);
/// The pose with the least squares of the misfit, from one nearby.
ShapePose fitted_pose(const ShapeTarget& target, const Eigen::Matrix3Xd& vertices_mm,
                      ShapePose pose);

}  // namespace misalign::solver
