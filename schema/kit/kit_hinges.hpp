// The hinges of a kit, mountains or valleys: how many, and what plates need to fold about them.
#pragma once

#include <string>

#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

struct KitHinges {
  const char* name;
  int count = 0;
  double length_mm = 0;
  double fold_deg = 0;  ///< of the sharpest, in the first so many rows of the sheet's history

  KitHinges(const solver::Sheet& sheet, bool valley, Eigen::Index rows);

  /// Between square edges of plates that a film joins at half their thickness: they meet where the
  /// plates enclose 2 atan(thickness / gap).
  double gap_mm(double thickness_mm) const;
  /// Of both edges, off square: so they lie on one another there.
  double bevel_deg() const { return 0.5 * fold_deg; }
};

/// Plates that are hinged on the faces on which their creases close, valleys on the one that looks
/// up and mountains on the other, do not meet: a closed walk round a vertex or a hole of the folded
/// sheet, plate by plate, ends beside where it began.
struct FaceHingeMisfit {
  double per_mm = 0;                   ///< of their thickness
  const solver::Loop* loop = nullptr;  ///< the worst one; null: flat

  /// "A8" or "the hole [1, 2]".
  std::string place(const solver::Sheet& sheet) const;
};

/// The largest in the first so many rows of the sheet's history.
FaceHingeMisfit face_hinge_misfit(const solver::Sheet& sheet, Eigen::Index rows);

}  // namespace misalign::schema
