// Lengths of the holes' diagonals: flat, and in a folded state.
#pragma once

#include "solver/loop_closure.hpp"

namespace misalign::solver {

/// Flat lengths in panel widths, one per diagonal.
void flat_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                  double* lengths);

/// Folded lengths in panel widths, one per diagonal, from the corners that each hole's loop passes.
void folded_lengths(const Mechanism& mechanism, const SheetGeometry<double>& geometry,
                    const FoldState<double>& state, double* lengths);

}  // namespace misalign::solver
