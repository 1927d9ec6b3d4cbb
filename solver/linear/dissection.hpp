// Nested dissection (George 1973) of the loops by their places: the unknowns of one part, those of
// the other, then those of loops in both. Cuts lie along x, y or a diagonal, wherever the expected
// cost is least: holes of a checkerboard are neighbours across their corners, so that an oblique
// cut of a given length meets fewer. Without it the cost of an elimination grows like the 2.3rd
// power of the unknowns on large sheets, with it like the 1.7th.
#pragma once

#include <vector>

#include "solver/kinematics/mechanism.hpp"

namespace misalign::solver {

/// Returns parts of the unknowns in their order of elimination. An unknown shares loops with its
/// own part and with parts that it separates or is separated by, never with those across a
/// separator.
std::vector<std::vector<int>> dissect(const Mechanism& mechanism, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
