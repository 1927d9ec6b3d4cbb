#include "search/sheets/preloaded_springs.hpp"

#include "search/sheets/card_drive.hpp"
#include "search/sheets/deploy_input.hpp"
#include "search/sheets/least_change.hpp"
#include "solver/bending/preload.hpp"

namespace misalign::search {

std::vector<PreloadedSprings> preloaded_springs(const CardSheet& on,
                                                std::span<const double> rates_n_per_mm) {
  const solver::Sheet& sheet = on.sheet;
  if (!on.design.is_springs() || on.stop_deg() > 0 || !sheet.base().springs.at_vertices()) {
    return {};
  }
  solver::ReleaseOptions release = release_of(on);
  const solver::BentPanelsOptions options = bending(on.design);
  if (!sheet.way() || *release.from_deg <= options.to_deg) return {};
  const double thickness_mm = release.sheet.plates.thickness_mm;
  const solver::BentWay way(sheet, options.material, thickness_mm, options.to_deg,
                            *release.from_deg, options.angles);
  if (!way.is_known()) return {};
  release.sheet.springs().preload = {1};
  const solver::Filling taut = solver::EnergyModel(sheet, release.sheet).filling();
  const Eigen::VectorXd shares = taut.forces_n(sheet.way()->flat_mm());
  const auto at_flat = solver::preload_at_flat(sheet, options.material, thickness_mm, shares);
  if (!at_flat) return {};
  const Eigen::VectorXd is_there = (taut.rates_n_per_mm().array() > 0).cast<double>();
  std::vector<PreloadedSprings> found;
  for (const double rate_n_per_mm : rates_n_per_mm) {
    const auto best =
        solver::best_preload(way, rate_n_per_mm * is_there, options.to_deg, *at_flat, shares);
    found.push_back({rate_n_per_mm, best.preload_n, best.static_n_mm_per_mm});
  }
  return found;
}

schema::Design with_springs(schema::Design design, const PreloadedSprings& springs) {
  design.stiffness_n_per_mm = springs.stiffness_n_per_mm;
  design.preload_n = two_digits(springs.preload_n);
  design.other_preloads.clear();
  return design;
}

}  // namespace misalign::search
