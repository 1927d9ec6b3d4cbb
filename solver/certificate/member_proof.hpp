// Proves in rational numbers that a sheet of the parallel family folds, and how far its diagonals
// are monotone: for overconstrained sheets too, whose equations interval arithmetic cannot prove.
// The theorem is in solver/pattern/README.md.
#pragma once

#include "solver/certificate/rational_base.hpp"

namespace misalign::solver {

/// Proof for a sheet in rational coordinates, which differ from its doubles by rounding.
struct MemberProof {
  ProofGap gap;  ///< nothing is proven if there is a gap
  /// Every diagonal is monotone up to here, and every crease keeps its sign; 180 is not included.
  double certified_deg = 0;
  int reversing_hole = -1;   ///< facet whose diagonals are not proven monotone; -1: none
  double base_off_mm = 0;    ///< largest rounding of an edge of the base, in x or y
  double member_off_mm = 0;  ///< largest rounding of a shift

  bool holds() const { return gap.kind == ProofGap::Kind::none; }
};

/// Proves up to `to_deg` at most; the base must be one of rational_base.
MemberProof prove_member(const PerforatedSheet& base, const Eigen::Matrix2Xd& shifts_mm,
                         double to_deg);

}  // namespace misalign::solver
