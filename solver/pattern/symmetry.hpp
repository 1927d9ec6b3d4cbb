// The sheet's symmetries, as what they do to the shifts of its vertices.
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

/// Those of the turns and reflections that keep the axes: vertices, facets and holes go to
/// vertices, facets and holes, shifted vertices to shifted ones, and mountains and valleys stay or
/// all change places. Without the identity; with each its inverse. None where springs end beside
/// the vertices: which panel has them at a ball joint goes by a sense of turning.
std::vector<ShiftSymmetry> shift_symmetries(const PerforatedSheet& base,
                                            const std::vector<int>& shifted);

}  // namespace misalign::solver
