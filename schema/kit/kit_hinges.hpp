// The hinges of a kit, mountains or valleys: how many, and what plates need to fold about them.
#pragma once

#include "solver/sheet/sheet.hpp"

namespace misalign::schema {

struct KitHinges {
  const char* name;
  const char* face;  ///< of the sheet on which panels that are butted are hinged: where they close
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

}  // namespace misalign::schema
