// The distance of two flat convex polygons in space, and where it lies.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Corners of a convex polygon in turn, a column each; two of them are a segment. At most eight: a
/// panel with all its corners cut off.
using PolygonCorners = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 8>;

struct Separation {
  double distance;             ///< 0 where they cross
  Eigen::Vector3d on_a, on_b;  ///< the closest points; where they cross, a common one
  /// Unit vector from a to b: normal of a face or of two edges where these are closest, which stays
  /// accurate down to no distance. Of no meaning where they cross.
  Eigen::Vector3d direction;
};

/// `a` has three corners or more. Of disjoint polygons: the least distance of any corner to the
/// other polygon and of any two edges (Ericson, Real-Time Collision Detection, 5.1). Where they
/// cross: an edge of one goes through the other.
Separation separation_of(const PolygonCorners& a, const PolygonCorners& b);

}  // namespace misalign::solver
