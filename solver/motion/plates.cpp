#include "solver/motion/plates.hpp"

#include <cassert>

namespace misalign::solver {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

PanelMass triangle(double area_density, const std::array<Vector2d, 3>& corners_mm) {
  const Vector2d centre_mm = (corners_mm[0] + corners_mm[1] + corners_mm[2]) / 3;
  const double area_mm2 = cross(corners_mm[1] - corners_mm[0], corners_mm[2] - corners_mm[0]) / 2;
  PanelMass mass{area_density * area_mm2, centre_mm, Eigen::Matrix2d::Zero()};
  for (const Vector2d& corner_mm : corners_mm) {
    const Vector2d arm_mm = corner_mm - centre_mm;
    mass.spread += mass.mass_t / 12 * arm_mm * arm_mm.transpose();
  }
  return mass;
}

// Adds two masses, by the parallel axis theorem.
PanelMass sum_of(const PanelMass& first, const PanelMass& second) {
  const double mass_t = first.mass_t + second.mass_t;
  assert(mass_t > 0);
  const Vector2d apart_mm = second.centre_mm - first.centre_mm;
  return {mass_t, first.centre_mm + second.mass_t / mass_t * apart_mm,
          first.spread + second.spread +
              first.mass_t * second.mass_t / mass_t * apart_mm * apart_mm.transpose()};
}

}  // namespace

std::vector<PanelMass> panel_masses(const Plates& plates,
                                    const std::vector<std::array<int, 4>>& panels,
                                    const FlatVertices& vertices_mm) {
  std::vector<PanelMass> masses;
  for (const auto& [a, b, c, d] : panels) {
    const auto half = [&, a = a](int second, int third) {
      return triangle(plates.area_density(),
                      {Vector2d(vertices_mm.col(a)), Vector2d(vertices_mm.col(second)),
                       Vector2d(vertices_mm.col(third))});
    };
    masses.push_back(sum_of(half(b, c), half(c, d)));
  }
  return masses;
}

}  // namespace misalign::solver
