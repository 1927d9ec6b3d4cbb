// The order in which the Jacobian of one topology is eliminated, chosen once: no search and no
// memory are needed afterwards.
#pragma once

#include "solver/linear/elimination.hpp"

namespace misalign::solver {

/// Markowitz' order (least fill first) within the parts of a nested dissection, among pivots that
/// are large in their column on the base folding at ten angles from 1 to 178 degrees and keep their
/// sign between them; how large is the least that solves well enough at ten other angles, on the
/// base folding and off it. The partner is a crease far from the pilot that moves fast near the
/// folded end. The same on every machine.
Elimination plan_elimination(const Mechanism& mechanism, const BaseFolding& folding,
                             const FlatVertices& base_vertices_mm);

}  // namespace misalign::solver
