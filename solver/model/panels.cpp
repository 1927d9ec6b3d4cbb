#include "solver/model/panels.hpp"

#include "solver/linear/newton.hpp"
#include "solver/pattern/outline.hpp"

namespace misalign::solver {

Panels panels_of(const PerforatedSheet& base, const Mechanism& mechanism) {
  Panels panels;
  panels.facets = kept_facets(base.sheet, base.holes);
  std::vector<int> panel_of(base.sheet.facets.size(), -1);
  for (std::size_t k = 0; k < panels.facets.size(); ++k) {
    panel_of[panels.facets[k]] = static_cast<int>(k);
    panels.corners.push_back(base.sheet.facets[panels.facets[k]]);
  }
  for (const Crease& crease : mechanism.creases) {
    panels.folds.push_back({crease.a, crease.b, panel_of[crease.left], panel_of[crease.right],
                            mechanism.is_valley(crease) ? 1 : -1});
  }
  return panels;
}

double shape_tolerance(const Panels& panels) {
  return Newton::Options{}.closure_tolerance * static_cast<double>(panels.facets.size());
}

}  // namespace misalign::solver
