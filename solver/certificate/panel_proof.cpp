#include "solver/certificate/panel_proof.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "solver/certificate/conditions.hpp"

namespace misalign::solver {
namespace {

using Eigen::Vector3d;
using Corners = std::array<GradedVector<JacobianModel>, 4>;

Vector3d middle_at(const GradedVector<JacobianModel>& point, double s) {
  return {guess_at(point.x, s), guess_at(point.y, s), guess_at(point.z, s)};
}

// Encloses direction . point for s from `from` to `to`.
struct Enclosure {
  double least, most;
};
Enclosure enclose(const Vector3d& direction, const GradedVector<JacobianModel>& point, double from,
                  double to) {
  const JacobianModel f =
      direction.x() * point.x + direction.y() * point.y + direction.z() * point.z;
  double steepest = 0;
  for (int k = 1; k <= kJacobianDegree; ++k) steepest += k * std::abs(f.c[k]);
  const Ball middle = polynomial_at(f, Ball(0.5 * (from + to)));
  const double reach =
      kUp * (middle.radius + f.radius + (0.5 * (to - from) + 4 * kUnit) * steepest);
  assert(!(reach < 0));
  return {middle.c[0] - kUp * reach, middle.c[0] + kUp * reach};
}

PanelCorners corners_at(const Corners& corners, double s) {
  PanelCorners middle;
  for (int k = 0; k < 4; ++k) middle.col(k) = middle_at(corners[k], s);
  return middle;
}

GradedVector<JacobianModel> arm(const Corners& corners, int at, int to) {
  const auto &from = corners[at], &end = corners[to];
  return {end.x - from.x, end.y - from.y, end.z - from.z};
}

// Returns whether a plane with this normal separates them for s from `from` to `to`.
bool are_apart(const ComparedPanels& panels, const Vector3d& direction, const Corners& a,
               const Corners& b, double from, double to) {
  if (panels.kind == ContactKind::apart) {
    double most_of_a = -std::numeric_limits<double>::infinity(), least_of_b = -most_of_a;
    for (int k = 0; k < 4; ++k) {
      most_of_a = std::max(most_of_a, enclose(direction, a[k], from, to).most);
      least_of_b = std::min(least_of_b, enclose(direction, b[k], from, to).least);
    }
    return most_of_a < least_of_b;
  }
  const int at_a = panels.vertex_of_a, at_b = panels.vertex_of_b;
  for (int side = 1; side < 4; ++side) {
    if (!(enclose(direction, arm(a, at_a, (at_a + side) % 4), from, to).most < 0)) return false;
    if (!(enclose(direction, arm(b, at_b, (at_b + side) % 4), from, to).least > 0)) return false;
  }
  return true;
}

}  // namespace

PanelProof::PanelProof(const FoldedShape& shape, const Panels& panels)
    : shape_(shape), panels_(panels), compared_(compared_panels(panels)) {}

PanelProof::Apart PanelProof::prove(const TubeProver& prover, const PathTube& tube,
                                    double resolution) const {
  const std::vector<Corners> corners = prover.place_panels(tube, shape_, panels_);
  assert(corners.size() == panels_.facets.size() && resolution > 0);
  Apart apart;
  for (const ComparedPanels& panels : compared_) {
    const Corners &a = corners[panels.a], &b = corners[panels.b];
    const auto are = [&](double from, double to) {
      const double s = 0.5 * (from + to);
      const auto direction = separating_direction(panels, corners_at(a, s), corners_at(b, s));
      return direction && are_apart(panels, *direction, a, b, from, to);
    };
    const double until = holds_until(are, apart.until, resolution);
    if (until < apart.until) apart = {until, panels.pair};
  }
  assert(apart.until >= -1 && apart.until <= 1);
  return apart;
}

}  // namespace misalign::solver
