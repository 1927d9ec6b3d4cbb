// Computes the corner of a panel at one of its vertices; names panels on a kit.
#pragma once

#include <algorithm>
#include <string>

#include "schema/pattern/pattern_file.hpp"
#include "solver/model/panel_pairs.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

/// "r1c2" for the panel [1, 2] of pattern files and catalogues.
inline std::string panel_label(const solver::Sheet& sheet, int facet) {
  const auto& [row, column] = sheet.base().sheet.places[static_cast<std::size_t>(facet)];
  return "r" + std::to_string(row) + "c" + std::to_string(column);
}

struct PanelCorner {
  PanelCorner(const solver::Sheet& sheet, int facet, int vertex) : at_mm(sheet.point_mm(vertex)) {
    const auto& around = sheet.base().sheet.facets[static_cast<std::size_t>(facet)];
    const auto k = static_cast<std::size_t>(solver::corner_of(around, vertex));
    const Eigen::Vector2d next = (sheet.point_mm(around[(k + 1) % 4]) - at_mm).normalized(),
                          previous = (sheet.point_mm(around[(k + 3) % 4]) - at_mm).normalized();
    bisector = (next + previous).normalized();
    sine = 0.5 * (next - previous).norm();
  }
  Eigen::Vector2d at_mm, bisector;  ///< bisector: a unit vector into the panel
  double sine;                      ///< sine of half the corner's angle
};

}  // namespace misalign::schema
