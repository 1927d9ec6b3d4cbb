// Makes one correction of Newton's method with the pilot held, in lanes.
#pragma once

#include <vector>

#include "solver/linear/sparse_lu.hpp"

namespace misalign::solver {

/// Corrects `state` by factors of its own Jacobian, or by those that `lu` has already; `turn` (one
/// per unknown, rad) becomes the correction. `residual` and `work` have room for one value per
/// unknown. It is never inlined: flattened into its users it takes two fifths of the lanes' compile
/// time (results/building.md).
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
  for (T& angle : turn) angle = -angle;
  advance(mechanism, turn.data(), state);
}

}  // namespace misalign::solver
