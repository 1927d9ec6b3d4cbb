// Finds the strokes of diagonals.
#pragma once

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

}  // namespace misalign::solver
