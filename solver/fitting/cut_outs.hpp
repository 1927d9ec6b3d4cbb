// Chooses the stress-free cut-outs of rubber plates, hole by hole, so that they drive a sheet.
#pragma once

#include "solver/sheet/sheet_filling.hpp"
#include "solver/studies/study_result.hpp"
#include "solver/studies/wanted.hpp"

namespace misalign::solver {

struct CutOutOptions {
  RubberPlates plates;  ///< rubber and thickness; cut-outs and pre-stretch are chosen
  double from_deg;      ///< angle from which they drive the sheet to flat
  /// The least angle that counts: unstretched plates drive with the cube of the angle.
  double to_deg = kMarginTo_deg;
  /// Range of the ratios of a cut-out's diagonals to those of the flat hole.
  double least = 0.8, most = 1;
  double coarse_step = 0.05, fine_step = 0.0125;
};

struct CutOutChoice {
  RubberPlates plates;
  /// The least dE / d(pilot^2) in steps of a degree up to the angle of use, and where; positive
  /// where the plates drive the sheet to flat from everywhere.
  double least_n_mm_per_rad2, at_deg;
  int rounds;  ///< passes over all holes
};

/// Raises the least dE / d(pilot^2) over the way by one hole's cut-out after the other, from
/// uniform ones and from one by weighted sums, first in coarse steps, then in fine ones. It is a
/// local optimum. Obstacles: an angle beyond the way; a lost path.
StudyResult<CutOutChoice> choose_cut_outs(const Sheet& sheet, const CutOutOptions& options);

/// The least dE / d(pilot^2) of a filling between two angles on the way, and where.
struct LeastDrive {
  double n_mm_per_rad2, at_deg;
};
LeastDrive least_drive(const FoldingWay& way, const Fill& fill, double from_deg,
                       double to_deg = kMarginTo_deg);

}  // namespace misalign::solver
