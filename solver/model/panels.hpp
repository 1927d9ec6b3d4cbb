// Lists a sheet's panels and the fold lines between them, against which folded shapes are checked.
#pragma once

#include <algorithm>
#include <cassert>

#include "solver/kinematics/mechanism.hpp"
#include "solver/kinematics/shape_check.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

struct Panels {
  std::vector<int> facets;                  ///< facet of each panel, ascending
  std::vector<std::array<int, 4>> corners;  ///< vertices, counter-clockwise seen from +z
  std::vector<FoldLine> folds;              ///< fold lines in the order of the mechanism's creases

  /// Index of the panel that is this facet, which must be one.
  int panel_of(int facet) const {
    const auto at = std::ranges::lower_bound(facets, facet);
    assert(at != facets.end() && *at == facet);
    return static_cast<int>(at - facets.begin());
  }
};

Panels panels_of(const PerforatedSheet& base, const Mechanism& mechanism);

/// Largest error of a folded shape, in rad and panel widths: a chain of joints passes at most as
/// many loops as there are panels, each open by at most the closure tolerance.
double shape_tolerance(const Panels& panels);

}  // namespace misalign::solver
