// Nested dissection (George 1973) of the loops by where they lie: unknowns of one part, of the
// other, then those that belong to loops of both. Cuts go along x, y or a diagonal, wherever the
// cost to be expected is least: the holes of a checkerboard are neighbours across their corners, so
// that an oblique cut of a given length meets fewer of them. Without it the cost of an elimination
// grows like the 2.3rd power of the unknowns on large sheets, with it like the 1.7th.
#pragma once

#include <vector>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// Unknowns in parts: an unknown has loops in common with those of its own part and of the parts it
/// separates or is separated by, never with those across a separator. In the order of elimination.
std::vector<std::vector<int>> dissect(const Mechanism& mechanism, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
