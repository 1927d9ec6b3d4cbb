// Finds the strokes of diagonals.
#pragma once

#include <algorithm>
#include <vector>

#include "solver/records/history.hpp"

namespace misalign::solver {

/// Default least stroke of every diagonal: laser cutters have larger errors, so that a shorter
/// stroke is no motion of the built sheet.
inline constexpr double kLeastStroke_mm = 0.01;

/// Largest change of each diagonal from its flat length, in the first `rows` rows.
inline std::vector<double> strokes_mm(const FoldingHistory& history, Eigen::Index rows) {
  std::vector<double> strokes_mm;
  for (std::size_t d = 0; d < history.flat_mm.size(); ++d) {
    const auto lengths_mm = history.length_mm.col(static_cast<Eigen::Index>(d)).head(rows).array();
    strokes_mm.push_back(rows == 0 ? 0 : (lengths_mm - history.flat_mm[d]).abs().maxCoeff());
  }
  return strokes_mm;
}

/// Largest elongation of a diagonal, a share of its flat length, in the first `rows` rows.
inline double largest_stroke(const FoldingHistory& history, Eigen::Index rows) {
  const std::vector<double> strokes = strokes_mm(history, rows);
  double largest = 0;
  for (std::size_t d = 0; d < strokes.size(); ++d) {
    largest = std::max(largest, strokes[d] / history.flat_mm[d]);
  }
  return largest;
}

}  // namespace misalign::solver
