// Gives in closed form the diagonals of one hole along the folding path of a sheet whose creases
// keep their directions. With a, b unit vectors along the hole's first two edges on the base, the
// edges of the shifted hole are A a + epsilon b and B b + delta a. README.md has the proof.
#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/pattern/half_angle.hpp"

namespace misalign::solver {

/// Signed area of the parallelogram that u and v span.
inline double spanned_area(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

/// A hole of the base and how the panels on its edges turn. T = tan^2(pilot / 2).
struct BaseHole {
  int facet;
  std::array<int, 4> corners;
  Eigen::Vector2d a, b;  ///< unit vectors from corner 0 to 1 and from 1 to 2
  double a_mm, b_mm;     ///< lengths of these edges
  double cosine, sine;   ///< cosine and sine of the angle from a to b
  /// tan^2(rho / 2) / T of the edge along a and of that along b; and the product of both tangents /
  /// T, with its sign.
  double a_ratio, b_ratio, mixed_ratio;
};

/// Components of the shifted hole's edges along a and b, mm: A a + epsilon b, B b + delta a.
struct HoleEdges {
  double a_mm, epsilon_mm, b_mm, delta_mm;
};

HoleEdges hole_edges(const BaseHole& hole, const Eigen::Matrix2Xd& vertices_mm);

/// Relative rounding error of a coefficient's terms that could change its sign: a hundred times
/// what a dozen roundings leave.
inline constexpr double kSlopeRounding = 1e-13;

class HoleMotion {
 public:
  HoleMotion(const BaseHole& hole, const HoleEdges& edges);

  /// p . q less its flat value, mm^2, where p and q are the folded edges: the squared diagonal from
  /// corner 1 to 3 changes by -2 times this, that from 2 to 0 by +2 times.
  double product_change_mm2(const HalfAngle<double>& pilot) const;
  /// Length in mm of diagonal 0 (corners 1, 3) or 1 (corners 2, 0).
  double length_mm(int diagonal, const HalfAngle<double>& pilot) const;
  double flat_mm(int diagonal) const;
  /// Rate of change of a diagonal's length, mm per radian of the pilot.
  double slope_mm(int diagonal, const HalfAngle<double>& pilot) const;
  /// Elongation |(L - L0) / L0| of the diagonal that changes less.
  double stroke(const HalfAngle<double>& pilot) const;

  /// Values of T at which both diagonals reverse, ascending: the sign changes of the quadratic that
  /// has the sign of -d(p . q)/dT. Infinite where there are fewer than two.
  std::array<double, 2> turns() const;
  /// +1 if from flat to 180 degrees the diagonal from corner 1 to 3 grows and the other shrinks, -1
  /// if they do the opposite, 0 if neither is certain.
  int direction() const;

 private:
  std::array<double, 3> slope_{}, size_{};  // coefficients, and the sizes of their terms
  std::array<double, 2> flat_sq_{};
  double along_a_, along_b_, mixed_;  // A delta, B epsilon, delta epsilon; mm^2
  double cosine_, sine_sq_, a_ratio_, b_ratio_, mixed_ratio_;
};

}  // namespace misalign::solver
