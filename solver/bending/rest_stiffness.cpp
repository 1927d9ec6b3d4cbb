#include "solver/bending/rest_stiffness.hpp"

#include "solver/bending/preload.hpp"

namespace misalign::solver {

using Eigen::VectorXd;

std::optional<RestStiffness> rest_stiffness(const Sheet& sheet, const ReleaseOptions& deploying,
                                            const PanelMaterial& material) {
  const Springs& springs = deploying.sheet.springs;
  const double thickness_mm = deploying.sheet.plates.thickness_mm;
  const FoldingWay* const way = sheet.way();
  const bool is_preloaded = springs.preload.is_any();
  if (!way || !springs.other_rests_deg.empty() || springs.rest_deg >= way->end_deg() ||
      (is_preloaded && springs.rest_deg > 0)) {
    return {};
  }
  if (springs.rest_deg == 0) {
    const double preload_n = springs.preload.largest_n();
    if (preload_n == 0) return RestStiffness{0, VectorXd::Zero(way->flat_mm().size())};
    const VectorXd shares = springs.preload.forces_n(sheet.mechanism().diagonals) / preload_n;
    const auto flat = preload_at_flat(sheet, material, thickness_mm, shares);
    if (!flat) return {};
    return RestStiffness{flat->stiffness_n_mm(preload_n), {}, flat->give_mm_per_n};
  }
  const double x = way->x_of(springs.rest_deg);
  VectorXd lengths_mm, slopes_mm;
  way->find_lengths(x, lengths_mm, slopes_mm);
  slopes_mm /= way->pilot_rate(x);
  const ElasticSheet panels(sheet.vertices_mm(), sheet.panels(), sheet.mechanism().diagonals,
                            material, thickness_mm);
  const auto compliance = find_compliance(panels, sheet.at(springs.rest_deg).vertices_mm);
  if (!compliance) return {};
  const VectorXd forces_n =
      bend(*compliance, {springs.stiffness_n_per_mm, compliance->lengths_mm - slopes_mm}).forces_n;
  return RestStiffness{slopes_mm.dot(forces_n), forces_n};
}

}  // namespace misalign::solver
