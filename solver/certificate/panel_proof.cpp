#include "solver/certificate/panel_proof.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "solver/certificate/conditions.hpp"
#include "solver/design/panel_distance.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;
using Corners = std::array<GradedVector<JacobianModel>, 4>;

Vector3d middle_at(const GradedVector<JacobianModel>& point, double s) {
  const auto value = [s](const JacobianModel& f) {
    double sum = 0;
    for (int k = kJacobianDegree; k >= 0; --k) sum = sum * s + f.c[k];
    return sum;
  };
  return {value(point.x), value(point.y), value(point.z)};
}

// The direction along which the least of the points is as far from the origin as can be: of the
// point nearest to it of all between them.
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

// Bounds of direction . point while s goes from `from` to `to`.
struct Bounds {
  double least, most;
};
Bounds bounds_of(const Vector3d& direction, const GradedVector<JacobianModel>& point, double from,
                 double to) {
  const JacobianModel f =
      direction.x() * point.x + direction.y() * point.y + direction.z() * point.z;
  double steepest = 0;
  for (int k = 1; k <= kJacobianDegree; ++k) steepest += k * std::abs(f.c[k]);
  JacobianModel p = f;
  p.radius = 0;
  const Ball middle = value_at(p, Ball(0.5 * (from + to)));
  const double reach =
      kUp * (middle.radius + f.radius + (0.5 * (to - from) + 4 * kUnit) * steepest);
  return {middle.c[0] - kUp * reach, middle.c[0] + kUp * reach};
}

PolygonCorners polygon_at(const Corners& corners, double s) {
  PolygonCorners polygon(3, 4);
  for (int k = 0; k < 4; ++k) polygon.col(k) = middle_at(corners[k], s);
  return polygon;
}

bool are_apart(const Corners& a, const Corners& b, double from, double to) {
  const double s = 0.5 * (from + to);
  const Separation separation = separation_of(polygon_at(a, s), polygon_at(b, s));
  if (!(separation.distance > 0)) return false;
  double most_of_a = -std::numeric_limits<double>::infinity(), least_of_b = -most_of_a;
  for (int k = 0; k < 4; ++k) {
    most_of_a = std::max(most_of_a, bounds_of(separation.direction, a[k], from, to).most);
    least_of_b = std::min(least_of_b, bounds_of(separation.direction, b[k], from, to).least);
  }
  return most_of_a < least_of_b;
}

GradedVector<JacobianModel> arm(const Corners& corners, int at, int to) {
  const auto &from = corners[at], &end = corners[to];
  return {end.x - from.x, end.y - from.y, end.z - from.z};
}

// Of two panels with one common vertex, the corners number at_a and at_b.
bool are_apart_but_for_vertex(const Corners& a, int at_a, const Corners& b, int at_b, double from,
                              double to) {
  const double s = 0.5 * (from + to);
  std::array<Vector3d, 4> arms;
  for (int k = 0; k < 2; ++k) {
    const int side = k == 0 ? 1 : 3;
    arms[k] = -middle_at(arm(a, at_a, (at_a + side) % 4), s).normalized();
    arms[2 + k] = middle_at(arm(b, at_b, (at_b + side) % 4), s).normalized();
  }
  const Vector3d direction = best_direction(arms);
  for (int side = 1; side < 4; ++side) {
    if (!(bounds_of(direction, arm(a, at_a, (at_a + side) % 4), from, to).most < 0)) return false;
    if (!(bounds_of(direction, arm(b, at_b, (at_b + side) % 4), from, to).least > 0)) return false;
  }
  return true;
}

int corner_of(const std::array<int, 4>& corners, int vertex) {
  return static_cast<int>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
}

}  // namespace

PanelProof::PanelProof(const Mechanism& mechanism, const FoldedShape& shape, const Panels& panels)
    : mechanism_(mechanism), shape_(shape), panels_(panels), pairs_(pairs_of(panels)) {}

PanelProof::Apart PanelProof::look(const TubeProver& prover, const PathTube& tube,
                                   double resolution) const {
  const std::vector<Corners> corners = prover.place_panels(tube, shape_, panels_);
  Apart apart;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const PanelPair& pair = pairs_[p];
    if (pair.kind == ContactKind::crease) continue;
    const auto are = [&](double from, double to) {
      const auto a = static_cast<std::size_t>(pair.a), b = static_cast<std::size_t>(pair.b);
      if (pair.kind == ContactKind::apart) return are_apart(corners[a], corners[b], from, to);
      return are_apart_but_for_vertex(corners[a], corner_of(panels_.corners[a], pair.joint),
                                      corners[b], corner_of(panels_.corners[b], pair.joint), from,
                                      to);
    };
    const double until = holds_until(are, apart.until, resolution);
    if (until < apart.until) apart = {until, static_cast<int>(p)};
  }
  return apart;
}

}  // namespace misalign::solver
