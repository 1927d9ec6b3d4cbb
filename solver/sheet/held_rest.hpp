// Finds how a filling that is relaxed at a folded angle drives a sheet there and holds it.
#pragma once

#include "solver/fill/filling.hpp"
#include "solver/sheet/folding_way.hpp"

namespace misalign::solver {

struct HeldRest {
  /// The energy falls to the rest from every angle between these; equal where it falls from none.
  double driven_from_deg, driven_from_below_deg;
  bool is_from_end;  ///< true: up to the end of the way, or to where a crease has folded flat
  /// Least rise of energy on a way out, over the largest energy towards flat or towards the end,
  /// and the angle of that.
  double barrier_n_mm, barrier_deg;
};

/// `rest_deg` lies on the way. Tops of the energy are known to 1e-9 of the way's length.
HeldRest held_rest(const FoldingWay& way, const Filling& filling, double rest_deg);

}  // namespace misalign::solver
