// Chooses once the order in which the Jacobian of one topology is eliminated: no search and no
// memory are needed afterwards.
#pragma once

#include "solver/linear/elimination.hpp"

namespace misalign::solver {

/// Markowitz' order (least fill first) within the parts of a nested dissection, among pivots that
/// on the base folding are large in their column at ten angles from 1 to 178 degrees and keep their
/// sign. The threshold is the smallest that solves well enough at ten other angles, on and off the
/// base folding. The partner is a crease far from the pilot that moves fast near the folded end.
/// The plan is the same on every machine.
Elimination plan_elimination(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm);

}  // namespace misalign::solver
