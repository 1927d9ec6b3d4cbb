// The study of gaps: how far the joints of miscut copies stay open where a sheet has more equations
// than unknowns. Its panels are rigid and folded as the sheet's own; each is put where all joints
// together are open least, by the sum of squares, to first order in the miscuts.
#pragma once

#include <vector>

#include "solver/sheet/sheet.hpp"

namespace misalign::solver {

struct MiscutGap {
  double amplitude_mm = 0;
  std::vector<double> pilot_deg;  ///< where copies were measured
  /// Copies x angles: the joint that is farthest open, a crease at the end where it is. With a
  /// play of that radius, or panels that bend by so much, the copy folds.
  Eigen::MatrixXd open_mm;

  /// At most so much in this share of the copies, at the k-th angle.
  double quantile_mm(double share, Eigen::Index k) const;
  /// The angle at which the median is largest.
  Eigen::Index worst_angle() const;
};

/// At the rows of the sheet's history; errors are a column per vertex and copy, mm. Of a sheet with
/// as many unknowns as equations joints close to first order: 0 but for rounding.
MiscutGap find_miscut_gaps(const Sheet& sheet, const std::vector<Eigen::Matrix2Xd>& errors_mm,
                           const std::vector<Eigen::Index>& rows);

}  // namespace misalign::solver
