// Defines the record of one path, from which metrics follow.
#pragma once

#include <optional>
#include <vector>

#include "solver/records/history.hpp"

namespace misalign::solver {

struct PathRecord {
  Verdict verdict;
  PathResult path;
  /// D by the filling's energy, beyond the verdict's D too (FoldingHistory).
  int energy_deploys_from_sample = 0;
  std::vector<double> flat;  ///< lengths of the diagonals, panel widths
  /// Lengths at the samples up to D, sample by sample.
  std::vector<double> lengths;
  /// Sum of lengths times |fold angle| of the creases there (turning_mm); none without a threshold.
  std::vector<double> turning_mm;
  PathExtremes extremes;
  /// Metrics of these names over the states that were solved for them, up to D.
  double singular_value_min = std::numeric_limits<double>::infinity();
  double residual_max = 0, isometry_error = 0;  ///< panel widths
  std::optional<double> miscut_margin_mm;
};

/// Makes the record of a path whose every sample was solved. Bumps are those of its cubics; without
/// extremes there is no reversal, and the least slope is the cubics'.
PathRecord record_of(const FoldingHistory& history, const Mechanism& mechanism);

}  // namespace misalign::solver
