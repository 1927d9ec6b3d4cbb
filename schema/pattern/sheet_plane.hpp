// Finds the plane of a file's sheet, in any orientation in space.
#pragma once

#include <string>
#include <vector>

#include "schema/pattern/plane_geometry.hpp"

namespace misalign::schema {

using SpacePoints = std::vector<Eigen::Vector3d>;

/// Axes of the sheet in those of the file, right-handed; `normal` points to the viewer.
struct SheetPlane {
  Eigen::Vector3d x_axis, y_axis, normal;
  double at;  ///< distance from the origin along the normal

  /// Returns whether x and y are the file's, seen from +z.
  bool is_the_files() const { return normal.z() == 1; }
  /// Returns the plane seen from its other side.
  SheetPlane from_behind() const { return {y_axis, x_axis, -normal, -at}; }
  PlanePoints flat(const SpacePoints& points) const;
  /// Returns a point's distance from the plane.
  double off(const Eigen::Vector3d& point) const { return std::abs(normal.dot(point) - at); }
  /// Returns "the plane y = 12.5: x and y of the sheet are z and x of the file".
  std::string name() const;
};

/// Returns the plane across z, else y or x, if all points lie within `within` of one; otherwise
/// that with the least sum of squared distances. It is seen from +z, +y or +x.
SheetPlane plane_of(const SpacePoints& points, double within);

}  // namespace misalign::schema
