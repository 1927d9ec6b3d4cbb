// A sheet to make kits of.
#pragma once

#include "../solver/sheets.hpp"
#include "schema/kit/kit_bores.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::schema {

/// A perforated Miura-ori with its interior vertices shifted by up to so much, and folded.
struct KitFixture : solver::TestSheet {
  KitFixture(int rows, int columns, const std::string& holes = "checkerboard-odd",
             double most_mm = 0.4)
      : TestSheet(rows, columns, holes),
        shifts_mm(Eigen::Matrix2Xd::Zero(2, base.sheet.vertex_count())) {
    std::srand(19);  // Eigen's Random
    for (const int v : solver::interior_vertices(base.sheet)) {
      shifts_mm.col(v) = most_mm * Eigen::Vector2d::Random();
    }
    vertices_mm = base.sheet.vertices_mm + shifts_mm;
    path = solver::record_shapes(solver::Model(base), vertices_mm);
  }

  Eigen::Matrix2Xd shifts_mm, vertices_mm;
  solver::ShapedPath path;
  KitSheet sheet{base, vertices_mm, shifts_mm, mechanism, path};
};

}  // namespace misalign::schema
