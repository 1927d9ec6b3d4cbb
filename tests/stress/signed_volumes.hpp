// Tests whether two panels cross, by the signs of tetrahedra's volumes alone.
#pragma once

#include <Eigen/Geometry>
#include <array>

namespace misalign::stress {

using Eigen::Vector3d;
using PanelCorners = Eigen::Matrix<double, 3, 4>;

inline double volume(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  return (b - a).cross(c - a).dot(d - a);
}

inline bool goes_through(const Vector3d& from, const Vector3d& to, const Vector3d& a,
                         const Vector3d& b, const Vector3d& c) {
  if (volume(a, b, c, from) * volume(a, b, c, to) >= 0) return false;
  const double one = volume(from, to, a, b), two = volume(from, to, b, c),
               three = volume(from, to, c, a);
  return (one > 0 && two > 0 && three > 0) || (one < 0 && two < 0 && three < 0);
}

/// An edge of `one` goes through one of the two triangles of `other`, or the reverse.
inline bool panels_cross(const PanelCorners& one, const PanelCorners& other) {
  const auto edges_through = [](const PanelCorners& edges, const PanelCorners& face) {
    for (int k = 0; k < 4; ++k) {
      const Vector3d from = edges.col(k), to = edges.col((k + 1) % 4);
      if (goes_through(from, to, face.col(0), face.col(1), face.col(2)) ||
          goes_through(from, to, face.col(0), face.col(2), face.col(3))) {
        return true;
      }
    }
    return false;
  };
  return edges_through(one, other) || edges_through(other, one);
}

/// Whether the sector between rays a and b has a ray in common with that between c and d.
inline bool sectors_cross(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                          const Vector3d& d) {
  const Vector3d one = a.cross(b), other = c.cross(d);
  if (one.dot(c) * one.dot(d) >= 0 || other.dot(a) * other.dot(b) >= 0) return false;
  const Vector3d common = one.cross(other);
  const auto within = [&](const Vector3d& normal, const Vector3d& from, const Vector3d& to,
                          const Vector3d& ray) {
    return normal.dot(from.cross(ray)) > 0 && normal.dot(ray.cross(to)) > 0;
  };
  return (within(one, a, b, common) && within(other, c, d, common)) ||
         (within(one, a, b, -common) && within(other, c, d, -common));
}

}  // namespace misalign::stress
