// Dual numbers: derivatives by the arithmetic of a quantity itself.
#pragma once

#include <cmath>

#include "solver/kinematics/diagonals.hpp"
#include "solver/kinematics/loop_closure.hpp"

namespace misalign::solver {

/// a + b e with e^2 = 0: the derivative by one unknown, exact to rounding, from the residual's own
/// arithmetic and none of the Jacobian's.
struct Dual {
  double a, b;
  Dual(double real = 0, double slope = 0) : a(real), b(slope) {}
  explicit Dual(int value) : a(value), b(0) {}
  friend Dual operator+(Dual x, Dual y) { return {x.a + y.a, x.b + y.b}; }
  friend Dual operator-(Dual x, Dual y) { return {x.a - y.a, x.b - y.b}; }
  friend Dual operator*(Dual x, Dual y) { return {x.a * y.a, x.a * y.b + x.b * y.a}; }
  friend Dual operator/(Dual x, Dual y) {
    return {x.a / y.a, (x.b * y.a - x.a * y.b) / (y.a * y.a)};
  }
  Dual operator-() const { return {-a, -b}; }
  friend bool operator<(Dual x, Dual y) { return x.a < y.a; }
  friend Dual sqrt(Dual x) { return {std::sqrt(x.a), x.b / (2 * std::sqrt(x.a))}; }
  friend Dual abs(Dual x) { return x.a < 0 ? -x : x; }
};

inline FoldState<Dual> as_dual(const FoldState<double>& state) {
  FoldState<Dual> dual;
  for (const auto& rho : state.creases) dual.creases.push_back({rho.c, rho.s});
  for (const auto& q : state.balls) dual.balls.push_back({q.w, q.x, q.y, q.z});
  return dual;
}

/// As place(), where the vertices move along a direction, mm for each mm.
inline SheetGeometry<Dual> placed(const Mechanism& mechanism, const FlatVertices& vertices_mm,
                                  const Eigen::Matrix2Xd& direction) {
  SheetGeometry<Dual> geometry;
  const Dual width(mechanism.panel_width_mm);
  for (Eigen::Index v = 0; v < vertices_mm.cols(); ++v) {
    const Eigen::Vector2d at = vertices_mm.col(v) - vertices_mm.col(0);
    const Eigen::Vector2d by = direction.col(v) - direction.col(0);
    geometry.x.push_back(Dual(at.x(), by.x()) / width);
    geometry.y.push_back(Dual(at.y(), by.y()) / width);
  }
  for (const Edge& edge : mechanism.edges) {
    const Dual dx = geometry.x[edge.b] - geometry.x[edge.a],
               dy = geometry.y[edge.b] - geometry.y[edge.a], length = sqrt(dx * dx + dy * dy);
    geometry.axis_x.push_back(dx / length);
    geometry.axis_y.push_back(dy / length);
  }
  return geometry;
}

}  // namespace misalign::solver
