#include "solver/pattern/hole_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace misalign::solver {
HoleEdges hole_edges(const BaseHole& hole, const Eigen::Matrix2Xd& vertices_mm) {
  const auto corner = [&](int k) {
    return Eigen::Vector2d(vertices_mm.col(hole.corners[static_cast<std::size_t>(k)]));
  };
  const Eigen::Vector2d along_a = corner(1) - corner(0), along_b = corner(2) - corner(1);
  return {spanned_area(along_a, hole.b) / hole.sine, spanned_area(hole.a, along_a) / hole.sine,
          spanned_area(hole.a, along_b) / hole.sine, spanned_area(along_b, hole.b) / hole.sine};
}

HoleMotion::HoleMotion(const BaseHole& hole, const HoleEdges& edges)
    : along_a_(edges.a_mm * edges.delta_mm),
      along_b_(edges.b_mm * edges.epsilon_mm),
      mixed_(edges.delta_mm * edges.epsilon_mm),
      cosine_(hole.cosine),
      sine_sq_(hole.sine * hole.sine),
      a_ratio_(hole.a_ratio),
      b_ratio_(hole.b_ratio),
      mixed_ratio_(hole.mixed_ratio) {
  // The edge along b turns a; the edge along a turns b.
  const double p = b_ratio_, q = a_ratio_, pq = p * q;
  const auto add = [&](std::size_t k, double term) {
    slope_[k] += term;
    size_[k] += std::abs(term);
  };
  add(0, along_a_ * p);
  add(0, along_b_ * q);
  add(0, 2 * mixed_ * mixed_ratio_);
  add(1, 2 * pq * along_a_);
  add(1, 2 * pq * along_b_);
  add(1, 4 * mixed_ * cosine_ * pq);
  add(2, pq * along_a_ * q);
  add(2, pq * along_b_ * p);
  add(2, 2 * pq * mixed_ * cosine_ * (p + q));
  add(2, -2 * pq * mixed_ * mixed_ratio_);
  const auto square = [&](double sign) {
    const double of_a = edges.a_mm + sign * edges.delta_mm;
    const double of_b = edges.epsilon_mm + sign * edges.b_mm;
    return of_a * of_a + of_b * of_b + 2 * of_a * of_b * cosine_;
  };
  flat_sq_ = {square(-1), square(1)};
}

double HoleMotion::product_change_mm2(const HalfAngle<double>& pilot) const {
  const double cc = pilot.c * pilot.c, ss = pilot.s * pilot.s;
  const double of_b = cc + b_ratio_ * ss, of_a = cc + a_ratio_ * ss;
  const double x = b_ratio_ * ss / of_b, y = a_ratio_ * ss / of_a;
  const double both = 2 * cosine_ * x * y + 2 * mixed_ratio_ * (ss / of_a) * (cc / of_b);
  return -2 * sine_sq_ * (along_a_ * x + along_b_ * y + mixed_ * both);
}

double HoleMotion::flat_mm(int diagonal) const {
  return std::sqrt(flat_sq_[static_cast<std::size_t>(diagonal)]);
}

double HoleMotion::length_mm(int diagonal, const HalfAngle<double>& pilot) const {
  const double change = 2 * product_change_mm2(pilot);
  return std::sqrt(std::max(
      0.0, flat_sq_[static_cast<std::size_t>(diagonal)] + (diagonal == 0 ? -change : change)));
}

// d(p . q)/dT = -2 s^2 (c0 + c1 T + c2 T^2) / ((1 + pT)(1 + qT))^2, and dT = (sin / cos^3) d pilot;
// both sides are multiplied by powers of the cosine, so that nothing is infinite at 180 degrees.
double HoleMotion::slope_mm(int diagonal, const HalfAngle<double>& pilot) const {
  const double cc = pilot.c * pilot.c, ss = pilot.s * pilot.s;
  const double of_both = (cc + b_ratio_ * ss) * (cc + a_ratio_ * ss);
  const double quadratic = slope_[0] * cc * cc + slope_[1] * cc * ss + slope_[2] * ss * ss;
  const double product = -2 * sine_sq_ * quadratic * pilot.s * pilot.c / (of_both * of_both);
  const double length = length_mm(diagonal, pilot);
  return length > 0 ? (diagonal == 0 ? -product : product) / length : 0;
}

std::array<double, 2> HoleMotion::turns() const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const auto& [c0, c1, c2] = slope_;
  const double under_root = c1 * c1 - 4 * c0 * c2;
  if (!(under_root > 0)) return {kNone, kNone};
  // The larger root comes first, which avoids a difference of nearly equal numbers.
  const double half = -0.5 * (c1 + std::copysign(std::sqrt(under_root), c1));
  std::array<double, 2> turns = {half / c2, c0 / half};
  for (double& turn : turns) {
    if (!(turn > 0)) turn = kNone;
  }
  std::ranges::sort(turns);
  return turns;
}

double HoleMotion::stroke(const HalfAngle<double>& pilot) const {
  const auto elongation = [&](int diagonal) {
    return std::abs(length_mm(diagonal, pilot) / flat_mm(diagonal) - 1);
  };
  return std::min(elongation(0), elongation(1));
}

int HoleMotion::direction() const {
  const auto sign = [&](std::size_t k) {
    if (std::abs(slope_[k]) <= kSlopeRounding * size_[k]) return 0;
    return slope_[k] > 0 ? 1 : -1;
  };
  const int at_flat = sign(0);
  if (at_flat == 0 || sign(2) != at_flat) return 0;
  // A quadratic whose outer coefficients have one sign has no root on T > 0 if its middle
  // coefficient has the same sign or is small.
  const double rounding = kSlopeRounding * (size_[1] * size_[1] + 4 * size_[0] * size_[2]);
  const bool clear =
      sign(1) == at_flat || slope_[1] * slope_[1] + rounding < 4 * slope_[0] * slope_[2];
  return clear ? at_flat : 0;
}

}  // namespace misalign::solver
