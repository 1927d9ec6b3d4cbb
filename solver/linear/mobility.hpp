// The number of degrees of freedom of a perforated sheet, by the rank of its Jacobian.
#pragma once

#include <vector>

#include "solver/pattern/base_folding.hpp"

namespace misalign::solver {

/// What the Jacobian says where the base sheet is folded to generic angles.
struct Mobility {
  int unknowns, equations, rank;
  int degrees_of_freedom() const { return unknowns - rank; }
  /// One, and no constraint too many: shifted sheets fold too.
  bool is_one() const { return rank == equations && degrees_of_freedom() == 1; }
};

/// Mobility by rank: the largest over pilot angles 40, 75 and 110 degrees (of 180; in proportion
/// where the base ends earlier). `holes` must have no hole_faults.
Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding);

}  // namespace misalign::solver
