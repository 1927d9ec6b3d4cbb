// A proof in rational numbers that a sheet of the parallel family folds, and how far its diagonals
// go one way: of overconstrained sheets too, of which no interval arithmetic can tell that all
// equations hold. The theorem is in solver/pattern/README.md.
#pragma once

#include "solver/certificate/rational_base.hpp"

namespace misalign::solver {

/// Of the sheet in rational coordinates that a sheet in doubles is nearly: both differ by rounding.
struct MemberProof {
  ProofGap gap;  ///< nothing is proven where there is one
  /// Up to here every diagonal of every hole only grows or only shrinks, and every crease keeps its
  /// sign; 180 is not included.
  double certified_deg = 0;
  int reversing_hole = -1;   ///< facet whose diagonals are not proven to go on; -1: none
  double base_off_mm = 0;    ///< the most by which an edge of the base was rounded, in x or y
  double member_off_mm = 0;  ///< the most by which a shift was

  bool holds() const { return gap.kind == ProofGap::Kind::none; }
};

/// Up to `to_deg` at most, of a base as rational_base takes it.
MemberProof prove_member(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                         double to_deg);

}  // namespace misalign::solver
