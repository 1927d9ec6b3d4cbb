// Finds the distance of two flat convex polygons in space, and their closest points.
#pragma once

#include <Eigen/Core>

namespace misalign::solver {

/// Corners of a convex polygon in turn, a column each; two of them are a segment. At most eight: a
/// panel with all its corners cut off.
using PolygonCorners = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 8>;

struct Separation {
  double distance;             ///< 0 if the polygons cross
  Eigen::Vector3d on_a, on_b;  ///< closest points, or a common one
  /// Unit vector from a to b: normal of a face or of two edges where these are closest, which stays
  /// accurate down to distance 0. Meaningless where polygons cross.
  Eigen::Vector3d direction;
};

/// Disjoint polygons have the least distance of any corner to the
/// other polygon and of any two edges (Ericson, Real-Time Collision Detection, 5.1). Where polygons
/// cross, an edge of one goes through the other.
Separation separation_of(const PolygonCorners& a, const PolygonCorners& b);

}  // namespace misalign::solver
