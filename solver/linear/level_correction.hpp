// Makes one correction of Newton's method along a level, in lanes: a weighted sum of the unknowns
// is held, not the pilot.
#pragma once

#include <vector>

#include "solver/linear/sparse_closure.hpp"

namespace misalign::solver {

/// Corrects `state` by `turn` (one per unknown, rad), which leaves the sum with the weights `level`
/// as it is; `tangent`, taken before the correction, changes that sum by 1. Returns the sign of det
/// [J; level]. It is never inlined: flattened into its users it takes two fifths of the lanes'
/// compile time (results/building.md).
template <class T>
[[gnu::noinline]] MISALIGN_FLATTEN T correct_on_level(
    const Mechanism& mechanism, const SheetGeometry<T>& geometry, const std::vector<T>& level,
    SparseClosure<T>& closure, std::vector<T>& turn, std::vector<T>& tangent, FoldState<T>& state) {
  closure.linearize(geometry, state);
  closure.solve(T(1), turn.data(), tangent.data());
  T by_turn(0), by_tangent(0);
  for (std::size_t j = 0; j < turn.size(); ++j) {
    by_turn = by_turn + level[j] * turn[j];
    by_tangent = by_tangent + level[j] * tangent[j];
  }
  const T scale = T(1) / by_tangent;
  for (std::size_t j = 0; j < turn.size(); ++j) {
    tangent[j] = tangent[j] * scale;
    turn[j] = by_turn * tangent[j] - turn[j];
  }
  advance(mechanism, turn.data(), state);
  return select(by_tangent < T(0), -closure.orientation(), closure.orientation());
}

}  // namespace misalign::solver
