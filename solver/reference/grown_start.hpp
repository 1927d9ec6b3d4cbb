// A start for the reference where shifts are large, and Newton's method straight from the base
// folding may find none, or another branch: the shifts grow in small steps, on dense matrices.
#pragma once

#include "solver/continuation/path.hpp"
#include "solver/pattern/crease_pattern.hpp"

namespace misalign::solver {

struct GrownStart {
  /// end_reached: all shifts have grown. fold_limit: the branch turns before. stalled: another
  /// branch crosses it, and the continuation is ambiguous.
  PathEnd end = PathEnd::stalled;
  double share = 0;         ///< share of the shifts that has grown
  FoldState<double> state;  ///< state at that share
};

/// Grows the shifts from this state of the base sheet, the pilot held. A step in which a crease
/// turns far or the Jacobian's determinant changes its sign is halved, down to 1e-8 of the shifts.
GrownStart grow_start(const Mechanism& mechanism, const FoldState<double>& base_state,
                      const FlatVertices& base_vertices_mm, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
