// A sheet to make kits of.
#pragma once

#include "../solver/sheets.hpp"
#include "schema/kit/kit_sheet.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// A perforated Miura-ori with its interior vertices shifted.
struct KitFixture : solver::TestSheet {
  KitFixture(int rows, int columns, const std::string& holes = "checkerboard-odd")
      : TestSheet(rows, columns, holes),
        shifts_mm(Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count())) {
    std::srand(19);  // Eigen's Random
    for (const int v : solver::interior_vertices(base.sheet)) {
      shifts_mm.col(v) = 0.4 * Eigen::Vector2d::Random();
    }
    vertices_mm = base.sheet.vertices_mm + shifts_mm;
  }

  Eigen::Matrix2Xd shifts_mm, vertices_mm;
  KitSheet sheet{base, vertices_mm, shifts_mm, mechanism};
};

}  // namespace misalign::schema
