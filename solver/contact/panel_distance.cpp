#include "solver/contact/panel_distance.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <limits>

namespace misalign::solver {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

struct PolygonPlane {
  Vector3d normal;
  double height;
};

PolygonPlane plane_of(const PolygonCorners& polygon) {
  assert(polygon.cols() >= 3);
  // The widest triangle from the first corner gives the normal: where corners are cut off, edges
  // may be short.
  Vector3d normal = Vector3d::Zero();
  for (Index k = 2; k < polygon.cols(); ++k) {
    normal += (polygon.col(k - 1) - polygon.col(0)).cross(polygon.col(k) - polygon.col(0));
  }
  normal.normalize();
  return {normal, normal.dot(polygon.col(0))};
}

// The point lies in the polygon's plane.
bool is_inside(const PolygonCorners& polygon, const Vector3d& normal, const Vector3d& point) {
  const Index count = polygon.cols();
  for (Index k = 0, before = count - 1; k < count; before = k++) {
    const Vector3d edge = polygon.col(k) - polygon.col(before);
    if (normal.dot(edge.cross(point - polygon.col(before))) < 0) return false;
  }
  return true;
}

// `normal`, of any length and sign, is that of the closest face or edges; 0: there is none.
void keep_closer(const Vector3d& on_a, const Vector3d& on_b, const Vector3d& normal,
                 Separation& closest) {
  const Vector3d apart = on_b - on_a;
  const double distance = apart.norm();
  if (distance >= closest.distance) return;
  closest = {distance, on_a, on_b, apart / std::max(distance, 1e-300)};
  if (const double length = normal.norm(); length > 0) {
    closest.direction = (normal.dot(apart) < 0 ? -1 : 1) / length * normal;
  }
}

// The closest points of p + s u and q + t v, s and t from 0 to 1.
void compare_segments(const Vector3d& p, const Vector3d& u, const Vector3d& q, const Vector3d& v,
                      Separation& closest) {
  const Vector3d apart = p - q;
  const double uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v);
  const double ua = u.dot(apart), va = v.dot(apart);
  const double across = uu * vv - uv * uv;
  const bool parallel = across <= 1e-15 * uu * vv;
  double s = parallel ? 0 : std::clamp((uv * va - ua * vv) / across, 0.0, 1.0);
  double t = (uv * s + va) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - ua) / uu, 0.0, 1.0);
  }
  const bool within = !parallel && s > 0 && s < 1 && t > 0 && t < 1;
  keep_closer(p + s * u, q + t * v, within ? Vector3d(u.cross(v)) : Vector3d::Zero(), closest);
}

// Corners of `points` above or below the polygon, and edges of theirs through it.
template <class Compare>
void compare_with_face(const PolygonCorners& face, const PolygonCorners& points,
                       const Compare& compare) {
  const PolygonPlane plane = plane_of(face);
  const Index count = points.cols();
  for (Index k = 0; k < count; ++k) {
    const Vector3d point = points.col(k);
    const double height = plane.normal.dot(point) - plane.height;
    const Vector3d foot = point - height * plane.normal;
    if (is_inside(face, plane.normal, foot)) compare(foot, point, plane.normal);
    const Vector3d next = points.col((k + 1) % count);
    const double next_height = plane.normal.dot(next) - plane.height;
    if (height * next_height >= 0) continue;
    const Vector3d through = point + height / (height - next_height) * (next - point);
    if (is_inside(face, plane.normal, through)) compare(through, through, plane.normal);
  }
}

}  // namespace

Separation separation_of(const PolygonCorners& a, const PolygonCorners& b) {
  assert(a.cols() >= 2 && b.cols() >= 2);
  Separation closest{std::numeric_limits<double>::infinity(), {}, {}, {}};
  if (a.cols() > 2) {
    compare_with_face(a, b,
                      [&](const Vector3d& on_a, const Vector3d& on_b, const Vector3d& normal) {
                        keep_closer(on_a, on_b, normal, closest);
                      });
  }
  if (b.cols() > 2) {
    compare_with_face(b, a,
                      [&](const Vector3d& on_b, const Vector3d& on_a, const Vector3d& normal) {
                        keep_closer(on_a, on_b, normal, closest);
                      });
  }
  for (Index i = 0; i < a.cols() - (a.cols() == 2); ++i) {
    const Vector3d p = a.col(i), u = a.col((i + 1) % a.cols()) - p;
    for (Index k = 0; k < b.cols() - (b.cols() == 2); ++k) {
      const Vector3d q = b.col(k), v = b.col((k + 1) % b.cols()) - q;
      compare_segments(p, u, q, v, closest);
    }
  }
  assert(closest.distance < std::numeric_limits<double>::infinity());
  return closest;
}

}  // namespace misalign::solver
