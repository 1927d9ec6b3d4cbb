// By how much diagonals become longer or shorter.
#pragma once

#include "solver/records/history.hpp"

namespace misalign::solver {

/// What every diagonal changes by at least where no miscut is named: laser cutters are off by more,
/// so that a shorter stroke is no motion of the sheet that is built.
inline constexpr double kLeastStroke_mm = 0.01;

/// Of each diagonal, how far its length is at most from that at flat, in the first rows.
inline std::vector<double> strokes_mm(const FoldingHistory& history, Eigen::Index rows) {
  std::vector<double> strokes_mm;
  for (std::size_t d = 0; d < history.flat_mm.size(); ++d) {
    const auto lengths_mm = history.length_mm.col(static_cast<Eigen::Index>(d)).head(rows).array();
    strokes_mm.push_back(rows == 0 ? 0 : (lengths_mm - history.flat_mm[d]).abs().maxCoeff());
  }
  return strokes_mm;
}

}  // namespace misalign::solver
