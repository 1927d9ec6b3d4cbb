// Patterns with their interior vertices shifted.
#pragma once

#include <cstdlib>

#include "schema/pattern/pattern_file.hpp"

namespace misalign::schema {

/// At random, by up to 1/400 of the panel width; one that has shifts stays as it is.
inline Pattern shifted(Pattern pattern) {
  if (!pattern.shifts_mm.isZero()) return pattern;
  const solver::CreasePattern& sheet = pattern.base.sheet;
  std::srand(6);  // Eigen's Random
  for (const int v : solver::interior_vertices(sheet)) {
    pattern.shifts_mm.col(v) = sheet.panel_width_mm / 400 * Eigen::Vector2d::Random();
  }
  return pattern;
}

}  // namespace misalign::schema
