// The sheet that a kit is made of: flat, and on its way.
#pragma once

#include <algorithm>
#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// Refers to what it is made of.
struct KitSheet {
  explicit KitSheet(const solver::Sheet& sheet) : path(sheet) {}

  const solver::Sheet& path;
  const solver::PerforatedSheet& base = path.model().base();
  const Eigen::Matrix2Xd& vertices_mm = path.vertices_mm();  ///< where they are cut
  const Eigen::Matrix2Xd& shifts_mm = path.shifts_mm();      ///< of that, off the base
  const solver::Mechanism& mechanism = path.mechanism();

  Eigen::Vector2d point(int vertex) const { return vertices_mm.col(vertex); }
  /// "r1c2" for the panel [1, 2] of pattern files and catalogues.
  std::string panel_label(int facet) const {
    const auto& [row, column] = base.sheet.places[static_cast<std::size_t>(facet)];
    return "r" + std::to_string(row) + "c" + std::to_string(column);
  }
};

/// The corner of a panel at one of its vertices.
struct PanelCorner {
  PanelCorner(const KitSheet& sheet, int facet, int vertex) : at_mm(sheet.point(vertex)) {
    const auto& around = sheet.base.sheet.facets[static_cast<std::size_t>(facet)];
    const auto k =
        static_cast<std::size_t>(std::find(around.begin(), around.end(), vertex) - around.begin());
    const Eigen::Vector2d one = (sheet.point(around[(k + 1) % 4]) - at_mm).normalized(),
                          other = (sheet.point(around[(k + 3) % 4]) - at_mm).normalized();
    bisector = (one + other).normalized();
    sine = 0.5 * (one - other).norm();
  }
  Eigen::Vector2d at_mm, bisector;  ///< which points into the panel
  double sine;                      ///< of half its angle
};

}  // namespace misalign::schema
