#include "solver/kinematics/fold_state.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace misalign::solver {
namespace {

// Rotation on crossing an edge: -rho about the direction that has the facet left behind on its
// left.
Quaternion<double> crossing_rotation(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                                     const BallJoint::Crossing& crossing,
                                     const HalfAngle<double>& rho) {
  const Edge& edge = mechanism.edges[crossing.edge];
  const Eigen::Vector2d axis =
      (vertices_mm.col(edge.b) - vertices_mm.col(edge.a)).normalized() * crossing.sense;
  return {rho.c, -rho.s * axis.x(), -rho.s * axis.y(), 0.0};
}

}  // namespace

FoldState<double> base_state(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm, const HalfAngle<double>& pilot) {
  if (folding.path()) return folding.path()->state(pilot);
  const std::vector<HalfAngle<double>> angles = folding.fold_angles(pilot);
  assert(angles.size() == mechanism.edges.size());
  FoldState<double> state;
  for (const Crease& crease : mechanism.creases) state.creases.push_back(angles[crease.edge]);
  for (const BallJoint& ball : mechanism.balls) {
    Quaternion<double> q{1, 0, 0, 0};
    for (const BallJoint::Crossing& crossing : ball.through) {
      q = q * crossing_rotation(mechanism, base_vertices_mm, crossing, angles[crossing.edge]);
    }
    state.balls.push_back(q.normalized());
  }
  return state;
}

FoldState<double> in_proportion(const FoldState<double>& state, double share) {
  assert(share > 0);
  FoldState<double> other = state;
  for (HalfAngle<double>& rho : other.creases) rho = half_angle_of_rad(share * angle_rad(rho));
  for (Quaternion<double>& q : other.balls) {
    q = Quaternion<double>{q.w, share * q.x, share * q.y, share * q.z}.normalized();
  }
  return other;
}

void place(const Mechanism& mechanism, const FlatVertices& vertices_mm,
           SheetGeometry<double>& geometry) {
  assert(vertices_mm.cols() == mechanism.vertices);
  assert(mechanism.panel_width_mm > 0);
  const std::size_t vertices = static_cast<std::size_t>(vertices_mm.cols());
  geometry.x.resize(vertices);
  geometry.y.resize(vertices);
  geometry.axis_x.resize(mechanism.edges.size());
  geometry.axis_y.resize(mechanism.edges.size());
  for (std::size_t v = 0; v < vertices; ++v) {
    const Eigen::Vector2d from_first =
        vertices_mm.col(static_cast<Eigen::Index>(v)) - vertices_mm.col(0);
    geometry.x[v] = from_first.x() / mechanism.panel_width_mm;
    geometry.y[v] = from_first.y() / mechanism.panel_width_mm;
  }
  for (std::size_t e = 0; e < mechanism.edges.size(); ++e) {
    const Edge& edge = mechanism.edges[e];
    const double dx = geometry.x[edge.b] - geometry.x[edge.a];
    const double dy = geometry.y[edge.b] - geometry.y[edge.a];
    const double length = std::sqrt(dx * dx + dy * dy);
    geometry.axis_x[e] = dx / length;
    geometry.axis_y[e] = dy / length;
  }
}

void find_crease_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                         std::vector<double>& creases_mm) {
  creases_mm.resize(mechanism.creases.size());
  for (std::size_t k = 0; k < creases_mm.size(); ++k) {
    const auto a = static_cast<std::size_t>(mechanism.creases[k].a),
               b = static_cast<std::size_t>(mechanism.creases[k].b);
    const double dx = geometry.x[b] - geometry.x[a], dy = geometry.y[b] - geometry.y[a];
    creases_mm[k] = std::sqrt(dx * dx + dy * dy) * mechanism.panel_width_mm;
  }
}

double turning_mm(const std::vector<double>& creases_mm,
                  const std::vector<HalfAngle<double>>& creases) {
  assert(creases_mm.size() == creases.size());
  constexpr std::size_t kAtOnce = 64;
  double sum_mm = 0, angles_rad[kAtOnce];
  for (std::size_t first = 0; first < creases.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, creases.size() - first);
    find_angles(creases.data() + first, static_cast<int>(count), angles_rad);
    for (std::size_t k = 0; k < count; ++k)
      sum_mm += creases_mm[first + k] * std::abs(angles_rad[k]);
  }
  return sum_mm;
}

}  // namespace misalign::solver
