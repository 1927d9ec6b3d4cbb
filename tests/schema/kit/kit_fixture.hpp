// A sheet to make kits of.
#pragma once

#include "schema/kit/kit_bores.hpp"
#include "solver/pattern/crease_pattern.hpp"
#include "tests/solver/own_sheet.hpp"
#include "tests/solver/sheets.hpp"

namespace misalign::schema {

/// A perforated Miura-ori with its interior vertices shifted by up to so much, and folded.
struct KitFixture : solver::TestSheet {
  KitFixture(int rows, int columns, const std::string& holes = "checkerboard-odd",
             double most_mm = 0.4, double width_mm = 80)
      : TestSheet(rows, columns, holes, width_mm), own(base, random_shifts(base.sheet, most_mm)) {}

  static Eigen::Matrix2Xd random_shifts(const solver::CreasePattern& pattern, double most_mm) {
    Eigen::Matrix2Xd shifts_mm = Eigen::Matrix2Xd::Zero(2, pattern.vertex_count());
    std::srand(19);  // Eigen's Random
    for (const int v : solver::interior_vertices(pattern)) {
      shifts_mm.col(v) = most_mm * Eigen::Vector2d::Random();
    }
    return shifts_mm;
  }

  const solver::OwnSheet own;
  const solver::Sheet& sheet = own.sheet;
  const Eigen::Matrix2Xd& vertices_mm = sheet.vertices_mm();
};

}  // namespace misalign::schema
