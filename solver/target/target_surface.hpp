// The surface that a folded sheet shall have: signed distances of points from it.
//
// The curvature of a surface can be scaled: it is the plane z = 0 at 0, and itself at 1. All but
// grids and meshes touch z = 0 at the origin.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace misalign::solver {

struct SurfaceDistance {
  double mm;               ///< positive above, on the side of +z
  Eigen::Vector3d normal;  ///< unit normal at the foot, towards +z: the gradient of the distance
};

class TargetSurface {
 public:
  virtual ~TargetSurface() = default;

  /// Distance of a point whose foot is unique and near; else of a point close to its foot.
  virtual SurfaceDistance distance(const Eigen::Vector3d& point_mm) const = 0;
  /// The same surface with this share of its curvature, from 0, a plane, to 1.
  virtual std::unique_ptr<TargetSurface> scaled(double share) const = 0;
  /// Largest principal curvature at the origin, 1/mm; of a grid, a bound of all second
  /// derivatives, of a mesh, of nearly all.
  virtual double curvature_per_mm() const = 0;
};

/// A surface that is a height above z = 0. Feet are found by Newton's method in x and y.
class HeightField : public TargetSurface {
 public:
  struct Height {
    double mm;
    Eigen::Vector2d slope;
    Eigen::Matrix2d bend_per_mm;  ///< second derivatives by x and y
  };

  SurfaceDistance distance(const Eigen::Vector3d& point_mm) const override;

 private:
  virtual Height at(const Eigen::Vector2d& place_mm) const = 0;
};

/// The plane z = 0.
std::unique_ptr<TargetSurface> plane();
/// A cylinder of this radius whose axis is parallel to y, a dome for positive radii, or to x.
std::unique_ptr<TargetSurface> cylinder(double radius_mm, bool along_x);
/// A sphere of this radius, a dome for positive radii.
std::unique_ptr<TargetSurface> sphere(double radius_mm);
/// The saddle z = (x^2 - y^2) / (2 radius).
std::unique_ptr<TargetSurface> saddle(double radius_mm);
/// The helicoid z = x tan(y / radius).
std::unique_ptr<TargetSurface> helicoid(double radius_mm);
/// Heights on a grid centred on the origin: `heights_mm` has a row per y, ascending, and a column
/// per x. Between them the surface is a bicubic spline with continuous slopes (Catmull and Rom
/// 1974), and beyond the grid it goes straight on. There must be at least two rows and columns.
std::unique_ptr<TargetSurface> height_grid(double spacing_mm, const Eigen::MatrixXd& heights_mm);

}  // namespace misalign::solver
