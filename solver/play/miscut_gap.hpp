// The study of gaps: the openings left in the joints of miscut copies where a sheet is
// overconstrained. Panels are rigid and folded as in the sheet; their places minimise the sum of
// squared openings, to first order in the miscuts.
#pragma once

#include <vector>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct MiscutGap {
  double amplitude_mm = 0;
  std::vector<double> pilot_deg;  ///< angles at which copies were measured
  /// Copies x angles: the largest opening of a joint, at either end of a crease. The copy folds
  /// with play of that radius, or panels that bend by that distance.
  Eigen::MatrixXd open_mm;

  /// Quantile of the opening over copies, at the k-th angle.
  double quantile_mm(double share, Eigen::Index k) const;
  /// The angle at which the median is largest.
  Eigen::Index worst_angle() const;
};

/// Finds gaps at rows of the sheet's history; errors have a column per vertex and copy, mm. Joints
/// of a sheet with as many unknowns as equations close to first order: 0 except for rounding.
MiscutGap find_miscut_gaps(const Sheet& sheet, const std::vector<Eigen::Matrix2Xd>& errors_mm,
                           const std::vector<Eigen::Index>& rows);

}  // namespace misalign::solver
