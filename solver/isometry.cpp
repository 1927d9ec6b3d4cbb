#include "solver/isometry.hpp"

#include <algorithm>
#include <cmath>

#include "solver/loop_closure.hpp"

namespace misalign::solver {

FoldedShape::FoldedShape(const CreasePattern& sheet, const std::vector<int>& holes,
                         const Mechanism& mechanism)
    : mechanism_(mechanism),
      facets_(sheet.facets),
      kept_(sheet.facets.size(), true),
      placed_by_(sheet.vertex_count(), -1) {
  for (const int f : holes) kept_[f] = false;
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
  for (const int f : frontier) {
    for (const int v : facets_[f]) {
      if (placed_by_[v] < 0) placed_by_[v] = f;
    }
  }
}

Eigen::Matrix3Xd FoldedShape::vertices_mm(const SheetGeometry<double>& geometry,
                                          const FoldState<double>& state) const {
  std::vector<Pose<double>> pose_of(facets_.size(), Pose<double>::identity());
  for (const Branch& branch : tree_) {
    pose_of[branch.facet] = pose_of[branch.parent].then_rotate(
        passage_rotation(mechanism_, geometry, state, branch.joint),
        flat_point(geometry, branch.joint.vertex));
  }
  Eigen::Matrix3Xd vertices(3, static_cast<Eigen::Index>(placed_by_.size()));
  for (int v = 0; v < static_cast<int>(placed_by_.size()); ++v) {
    const Vec3<double> p = pose_of[placed_by_[v]] * flat_point(geometry, v);
    vertices.col(v) = Eigen::Vector3d(p.x, p.y, p.z) * mechanism_.panel_width_mm;
  }
  return vertices;
}

double FoldedShape::isometry_error_mm(const FlatVertices& flat_mm,
                                      const Eigen::Matrix3Xd& folded_mm) const {
  double worst = 0;
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    if (!kept_[f]) continue;
    for (int i = 0; i < 4; ++i) {
      for (int k = i + 1; k < 4; ++k) {
        const int a = facets_[f][i], b = facets_[f][k];
        const double flat = (flat_mm.col(a) - flat_mm.col(b)).norm();
        const double folded = (folded_mm.col(a) - folded_mm.col(b)).norm();
        worst = std::max(worst, std::abs(folded - flat));
      }
    }
  }
  return worst;
}

}  // namespace misalign::solver
