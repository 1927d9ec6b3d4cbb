#include "solver/kinematics/folded_shape.hpp"

#include <algorithm>
#include <cassert>

namespace misalign::solver {

FoldedShape::FoldedShape(const CreasePattern& sheet, const std::vector<int>& holes,
                         const Mechanism& mechanism)
    : mechanism_(mechanism),
      facets_(sheet.facets),
      kept_(sheet.facets.size(), true),
      placed_by_(sheet.vertex_count(), -1) {
  for (const int f : holes) kept_[f] = false;
  assert(std::count(kept_.begin(), kept_.end(), true) > 0);  // there is a root
  root_ = static_cast<int>(std::find(kept_.begin(), kept_.end(), true) - kept_.begin());

  std::vector<bool> reached(facets_.size(), false);
  std::vector<int> frontier{root_};
  reached[root_] = true;
  const auto try_joint = [&](int at, int from, int to, Passage joint) {
    if (at == to) std::swap(from, to), joint.sense = -joint.sense;
    if (at != from || reached[to]) return;
    reached[to] = true;
    tree_.push_back({joint, from, to});
    frontier.push_back(to);
  };
  for (std::size_t next = 0; next < frontier.size(); ++next) {
    const int at = frontier[next];
    for (int i = 0; i < static_cast<int>(mechanism.creases.size()); ++i) {
      const Crease& crease = mechanism.creases[i];
      try_joint(at, crease.left, crease.right, {false, i, 1, crease.a});
    }
    for (int i = 0; i < static_cast<int>(mechanism.balls.size()); ++i) {
      const BallJoint& ball = mechanism.balls[i];
      try_joint(at, ball.from_facet, ball.to_facet, {true, i, 1, ball.vertex});
    }
  }
  assert(std::ssize(frontier) == std::count(kept_.begin(), kept_.end(), true));  // joints reach all
  for (const int f : frontier) {
    for (const int v : facets_[f]) {
      if (placed_by_[v] < 0) placed_by_[v] = f;
    }
  }
}

Eigen::Vector3d FoldedShape::seen_mm(const Vec3<double>& point) const {
  return Eigen::Vector3d(point.x, point.y, mechanism_.side * point.z) * mechanism_.panel_width_mm;
}

Eigen::Matrix3Xd FoldedShape::vertices_mm(const SheetGeometry<double>& geometry,
                                          const FoldState<double>& state) const {
  Points<double> points;
  place(geometry, state, points);
  assert(points.vertices.size() == placed_by_.size());
  Eigen::Matrix3Xd vertices_mm(3, static_cast<Eigen::Index>(points.vertices.size()));
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    vertices_mm.col(v) = seen_mm(points.vertices[v]);
  }
  return vertices_mm;
}

Eigen::Matrix3Xd FoldedShape::corners_mm(const SheetGeometry<double>& geometry,
                                         const FoldState<double>& state) const {
  Points<double> points;
  place(geometry, state, points);
  Eigen::Matrix3Xd corners_mm(3, 4 * std::count(kept_.begin(), kept_.end(), true));
  Eigen::Index corner = 0;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!kept_[f]) continue;
    for (const int v : facets_[f]) {
      corners_mm.col(corner++) = seen_mm(points.facets[f] * flat_point(geometry, v));
    }
  }
  return corners_mm;
}

}  // namespace misalign::solver
