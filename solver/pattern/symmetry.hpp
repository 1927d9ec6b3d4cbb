// Finds the sheet's symmetries as mappings of its vertex shifts.
#pragma once

#include <vector>

#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

/// A sheet with shifts s (x and y of each shifted vertex in turn) looks like one with shifts
/// (negated[i] ? -1 : 1) s[from[i]], turned or turned over.
struct ShiftSymmetry {
  std::vector<int> from;
  std::vector<char> negated;
};

/// Rotations and reflections that keep the axes and map vertices, shifted vertices, facets and
/// holes to their like; mountains and valleys stay, or all are exchanged. The identity is left out;
/// each has its inverse in the list. Empty if springs end beside the vertices: a sense of turning
/// decides which panel carries them at a ball joint.
std::vector<ShiftSymmetry> shift_symmetries(const PerforatedSheet& base,
                                            const std::vector<int>& shifted);

}  // namespace misalign::solver
