// Finds the energy of a filling along a folded path, and up to which angles energy and diagonals
// drive the sheet.
#pragma once

#include <vector>

#include "solver/fill/fill.hpp"
#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct EnergyHistory {
  /// Energies at the history's stations; none of a sheet that folds well at none.
  std::vector<double> energy_n_mm;
  /// Last sample up to which creases are in order and the energy rises from flat at every sample.
  int deploys_from_sample = 0;
  bool rises_to_the_end = true;  ///< false if the energy falls at the sample after
  int where = -1;                ///< then the diagonal whose part of the energy falls most, or -1
  /// Last sample up to which creases are in order and all diagonals are monotone.
  int monotone_to_sample = 0;
};

/// Finds both for a filling that is relaxed flat apart from preload or pre-stretch.
EnergyHistory energy_history(const Sheet& sheet, const FoldingHistory& history, const Fill& fill);

}  // namespace misalign::solver
