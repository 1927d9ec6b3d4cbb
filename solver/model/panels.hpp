// The panels that are left of a sheet, and the fold lines between them: what a folded shape is
// checked against.
#pragma once

#include "solver/kinematics/mechanism.hpp"
#include "solver/kinematics/shape_check.hpp"
#include "solver/pattern/perforation.hpp"

namespace misalign::solver {

struct Panels {
  std::vector<int> facets;                  ///< of each panel, ascending
  std::vector<std::array<int, 4>> corners;  ///< vertices, counter-clockwise seen from +z
  std::vector<FoldLine> folds;              ///< in the order of the mechanism's creases
};

Panels panels_of(const PerforatedSheet& base, const Mechanism& mechanism);

/// What a folded shape may be off by, in rad and panel widths: a chain of joints passes at most as
/// many loops as there are panels, each open by no more than the closure tolerance.
double shape_tolerance(const Panels& panels);

}  // namespace misalign::solver
