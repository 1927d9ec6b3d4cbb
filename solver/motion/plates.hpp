// Panels as plates of one thickness and one material: their masses and second moments.
#pragma once

#include <array>
#include <vector>

#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

/// The paper's plates, section 5: 1 mm of aluminium.
struct Plates {
  double thickness_mm = 1;
  double density_g_per_cm3 = 2.7;

  /// Per area of a panel, t/mm^2: with N, mm and s, masses are in tonnes.
  double area_density() const { return thickness_mm * density_g_per_cm3 * 1e-9; }
};

/// The mass of a panel on the flat sheet.
struct PanelMass {
  double mass_t;
  Eigen::Vector2d centre_mm;
  /// Integral of (x - centre) (x - centre)^T over its mass, t mm^2. The thickness adds nothing: a
  /// panel is a sheet at its mid-plane.
  Eigen::Matrix2d spread;
};

/// Masses of all panels (corners as vertices, counter-clockwise), each cut in two along a diagonal.
std::vector<PanelMass> panel_masses(const Plates& plates,
                                    const std::vector<std::array<int, 4>>& panels,
                                    const FlatVertices& vertices_mm);

}  // namespace misalign::solver
