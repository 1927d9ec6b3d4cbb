// The plane in which a file's sheet lies, in whatever way it stands in space.
#pragma once

#include <string>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

using SpacePoints = std::vector<Eigen::Vector3d>;

/// Axes of the sheet in the file's, a right-handed system: the sheet is seen from where `normal`
/// points to.
struct SheetPlane {
  Eigen::Vector3d x_axis, y_axis, normal;
  double at;  ///< where the normal meets it

  /// Whether x and y are the file's own, seen from +z.
  bool is_the_files() const { return normal.z() == 1; }
  /// The same plane seen from its other side.
  SheetPlane from_behind() const { return {y_axis, x_axis, -normal, -at}; }
  PlanePoints flat(const SpacePoints& points) const;
  /// How far a point is from it.
  double off(const Eigen::Vector3d& point) const { return std::abs(normal.dot(point) - at); }
  /// "the plane y = 12.5: x and y of the sheet are z and x of the file".
  std::string name() const;
};

/// The plane across z, else y or x, where all points lie within `within` of one; otherwise the one
/// with the least sum of squared distances. It is seen from +z, +y or +x.
SheetPlane plane_of(const SpacePoints& points, double within);

}  // namespace misalign::schema
