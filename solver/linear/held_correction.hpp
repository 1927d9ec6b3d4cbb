// One correction of Newton's method with the pilot held, in lanes.
#pragma once

#include <vector>

#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

/// Corrects `state` by factors of its own Jacobian, or those that `lu` has already; `turn` (one per
/// unknown, rad) is what it was turned by. `residual` and `work` have room for one value per
/// unknown. It is a call wherever it is used: flattened into each of its users it takes two fifths
/// of the time in which the lanes compile (results/building.md).
template <class T>
[[gnu::noinline]] MISALIGN_FLATTEN void correct_held(const Mechanism& mechanism,
                                                     const SheetGeometry<T>& geometry,
                                                     bool new_factors, SparseLu<T>& lu,
                                                     std::vector<T>& residual, std::vector<T>& work,
                                                     std::vector<T>& turn, FoldState<T>& state) {
  if (new_factors) {
    evaluate(mechanism, geometry, state, residual.data(), lu.entries());
    lu.factorize(residual.data(), work.data());
  } else {
    evaluate(mechanism, geometry, state, residual.data(), nullptr);
    lu.forward(residual.data(), work.data());
  }
  lu.backward_held(work.data(), turn.data());
  for (T& by : turn) by = -by;
  advance(mechanism, turn.data(), state);
}

}  // namespace misalign::solver
