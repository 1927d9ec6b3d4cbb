#include "solver/certificate/panel_directions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>

#include "solver/contact/panel_distance.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;

// The direction in which the nearest of the points is farthest from the origin: that of their
// convex hull's nearest point.
Vector3d best_direction(const std::array<Vector3d, 4>& points) {
  Vector3d best = Vector3d::UnitZ();
  double most = -1;
  const auto try_direction = [&](const Vector3d& direction) {
    const double length = direction.norm();
    if (!(length > 1e-9)) return;
    double least = 1;
    for (const Vector3d& p : points) least = std::min(least, direction.dot(p) / length);
    if (least > most) {
      most = least;
      best = direction / length;
    }
  };
  for (int i = 0; i < 4; ++i) {
    try_direction(points[i]);
    for (int j = i + 1; j < 4; ++j) {
      const Vector3d side = points[j] - points[i];
      try_direction(points[i] - side * (side.dot(points[i]) / std::max(side.squaredNorm(), 1e-30)));
      for (int k = j + 1; k < 4; ++k) {
        const Vector3d normal = side.cross(points[k] - points[i]);
        try_direction(normal);
        try_direction(-normal);
      }
    }
  }
  return best;
}

}  // namespace

std::vector<ComparedPanels> compared_panels(const Panels& panels) {
  std::vector<ComparedPanels> compared;
  const std::vector<PanelPair> pairs = pairs_of(panels);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const PanelPair& pair = pairs[p];
    if (pair.kind == ContactKind::crease) continue;
    const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
    const bool joined = pair.kind == ContactKind::vertex;
    assert(a < b && b < panels.corners.size());
    compared.push_back({pair.kind, a, b, joined ? corner_of(panels.corners[a], pair.joint) : 0,
                        joined ? corner_of(panels.corners[b], pair.joint) : 0,
                        static_cast<int>(p)});
  }
  return compared;
}

std::optional<Vector3d> separating_direction(const ComparedPanels& panels, const PanelCorners& a,
                                             const PanelCorners& b) {
  if (panels.kind == ContactKind::apart) {
    const Separation separation = separation_of(a, b);
    if (!(separation.distance > 0)) return std::nullopt;
    return separation.direction;
  }
  assert(panels.kind == ContactKind::vertex && panels.vertex_of_a < 4 && panels.vertex_of_b < 4);
  std::array<Vector3d, 4> arms;
  for (int k = 0; k < 2; ++k) {
    const int side = k == 0 ? 1 : 3;
    const int at_a = panels.vertex_of_a, at_b = panels.vertex_of_b;
    arms[k] = (a.col(at_a) - a.col((at_a + side) % 4)).normalized();
    arms[2 + k] = (b.col((at_b + side) % 4) - b.col(at_b)).normalized();
  }
  return best_direction(arms);
}

}  // namespace misalign::solver
