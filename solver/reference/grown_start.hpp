// A start for the reference where shifts are large, and Newton's method from the base folding may
// find another branch: on dense matrices, in steps so small that it cannot leave its own.
#pragma once

#include "solver/kinematics/fold_state.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

struct GrownStart {
  /// Up to which the shifts grew: 1, all of them, unless the branch turns before.
  double share = 0;
  FoldState<double> state;  ///< there

  bool is_whole() const { return share == 1; }
};

/// From this state of the base sheet, the pilot held, in so many equal steps of the shifts.
GrownStart grow_start(const Mechanism& mechanism, const FoldState<double>& base_state,
                      const FlatVertices& base_vertices_mm, const FlatVertices& vertices_mm,
                      int steps);

}  // namespace misalign::solver
