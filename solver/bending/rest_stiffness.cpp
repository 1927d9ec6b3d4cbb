#include "solver/bending/rest_stiffness.hpp"

#include "solver/bending/preload.hpp"

namespace misalign::solver {

using Eigen::VectorXd;

// Forces of diagonals that are off by less are those of rounding.
constexpr double kNoForce_mm = 1e-9;

std::optional<RestStiffness> rest_stiffness(const Sheet& sheet, const ReleaseOptions& deploying,
                                            const PanelMaterial& material) {
  const FoldingWay* const way = sheet.way();
  const double at_deg = rest_deg(deploying.sheet.fill);
  const auto* const springs = std::get_if<Springs>(&deploying.sheet.fill);
  if (!way || at_deg >= way->end_deg() || (springs && !springs->other_rests_deg.empty())) return {};
  const double x = way->x_of(at_deg), thickness_mm = deploying.sheet.plates.thickness_mm;
  VectorXd lengths_mm = way->flat_mm(), slopes_mm;
  if (at_deg > 0) way->find_lengths(x, lengths_mm, slopes_mm);
  const Filling filling = filling_on(*way, deploying.sheet.fill);
  const VectorXd left_n = filling.forces_n(lengths_mm);  // by preload or pre-stretch
  const double most_n = left_n.cwiseAbs().maxCoeff();
  const bool is_preloaded =
      most_n > kNoForce_mm * filling.stiffness_n_per_mm(lengths_mm).maxCoeff();
  if (at_deg == 0) {
    if (!is_preloaded) return RestStiffness{0, VectorXd::Zero(lengths_mm.size())};
    const auto flat = preload_at_flat(sheet, material, thickness_mm, left_n / most_n);
    if (!flat) return {};
    return RestStiffness{flat->stiffness_n_mm(most_n), {}, flat->give_mm_per_n};
  }
  if (is_preloaded) return {};
  slopes_mm /= way->pilot_rate(x);
  const ElasticSheet panels(sheet.vertices_mm(), sheet.panels(), sheet.mechanism().diagonals,
                            material, thickness_mm);
  const auto compliance = find_compliance(panels, sheet.at(at_deg).vertices_mm);
  if (!compliance) return {};
  const Eigen::MatrixXd stiffness = filling.stiffness_n_per_mm(lengths_mm);
  const VectorXd forces_n = softened(*compliance, stiffness, stiffness * slopes_mm);
  return RestStiffness{slopes_mm.dot(forces_n), forces_n};
}

}  // namespace misalign::solver
