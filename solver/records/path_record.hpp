// The record of one path: what metrics need to know of it.
#pragma once

#include <optional>
#include <vector>

#include "solver/records/history.hpp"

namespace misalign::solver {

struct PathRecord {
  Verdict verdict;
  PathResult path;
  std::vector<double> flat;  ///< lengths of the diagonals, panel widths
  /// The same at the samples up to D: sample by sample.
  std::vector<double> lengths;
  PathExtremes extremes;
  /// Up to D, of the states that were solved for the purpose: see the metrics of these names.
  double singular_value_min = std::numeric_limits<double>::infinity();
  double residual_max = 0, isometry_error = 0;  ///< panel widths
  std::optional<double> miscut_margin_mm;
};

/// The same of a path whose every sample was solved. Bumps are those of its cubics; without
/// extremes it has no reversal, and the cubics' least slope.
PathRecord record_of(const FoldingHistory& history, const Mechanism& mechanism);

}  // namespace misalign::solver
