// Measures the hinges of a kit, mountains or valleys: count, lengths, gaps and bevels of plates.
#pragma once

#include <string>

#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

struct KitHinges {
  const char* name;
  int count = 0;
  double length_mm = 0;
  double fold_deg = 0;  ///< largest fold angle in the history's first `rows` rows

  KitHinges(const solver::Sheet& sheet, bool valley, Eigen::Index rows);

  /// The gap between square edges of plates that a film joins at half their thickness. The edges
  /// meet where the plates enclose 2 atan(thickness / gap).
  double gap_mm(double thickness_mm) const;
  /// The bevel of both edges, from square, with which they lie on one another at the largest fold.
  double bevel_deg() const { return 0.5 * fold_deg; }
};

/// Plates that are hinged on the faces on which their creases close, valleys on the one that looks
/// up and mountains on the other, do not meet: a closed walk round a vertex or a hole of the folded
/// sheet, plate by plate, ends beside where it began.
struct FaceHingeMisfit {
  double per_mm = 0;                   ///< gap per thickness
  const solver::Loop* loop = nullptr;  ///< the worst one; null: flat

  /// "A8" or "the hole [1, 2]".
  std::string place(const solver::Sheet& sheet) const;
};

/// The largest misfit in the history's first `rows` rows.
FaceHingeMisfit face_hinge_misfit(const solver::Sheet& sheet, Eigen::Index rows);

}  // namespace misalign::schema
