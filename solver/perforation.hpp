// Which facets are holes, and how many degrees of freedom that leaves.
#pragma once

#include <string>
#include <vector>

#include "solver/base_folding.hpp"
#include "solver/crease_pattern.hpp"

namespace misalign::solver {

/// What is wrong with these holes, a sentence each; empty when none lies on the perimeter or shares
/// an edge with another.
std::vector<std::string> hole_faults(const CreasePattern& sheet, const std::vector<int>& holes);

/// d.f. = 3j - (t + 6) of the panel truss, equation (2.1): j joints, t members, of which two are
/// the diagonals of each kept facet.
int counted_mobility(const CreasePattern& sheet, const std::vector<int>& holes);

/// What the Jacobian says where the base sheet is folded to generic angles.
struct Mobility {
  int unknowns, equations, rank;
  int degrees_of_freedom() const { return unknowns - rank; }
};

/// Mobility by rank: the largest over pilot angles 40, 75 and 110 degrees. `holes` must have no
/// hole_faults.
Mobility measured_mobility(const CreasePattern& sheet, const std::vector<int>& holes,
                           const BaseFolding& folding);

}  // namespace misalign::solver
