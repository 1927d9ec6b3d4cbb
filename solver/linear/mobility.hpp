// Counts the degrees of freedom of a perforated sheet by the rank of its Jacobian.
#pragma once

#include <vector>

#include "solver/pattern/base_folding.hpp"

namespace misalign::solver {

/// Rank of the Jacobian with the base sheet folded to generic angles.
struct Mobility {
  int unknowns, equations, rank;
  int degrees_of_freedom() const { return unknowns - rank; }
  /// True for one degree of freedom without redundant equations: shifted sheets fold too.
  bool is_one() const { return rank == equations && degrees_of_freedom() == 1; }
};

/// Mobility by the largest rank at pilot angles of 40, 75 and 110 degrees (of 180; in proportion if
/// the base ends earlier). `holes` must have no hole_faults.
Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding);

}  // namespace misalign::solver
