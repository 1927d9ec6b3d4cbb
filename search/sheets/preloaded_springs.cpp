#include "search/sheets/preloaded_springs.hpp"

#include "search/sheets/card_drive.hpp"
#include "search/sheets/deploy_input.hpp"
#include "solver/bending/preload.hpp"

namespace misalign::search {

std::vector<PreloadedSprings> preloaded_springs(const CardSheet& on,
                                                std::span<const double> rates_n_per_mm) {
  if (!on.design.is_springs() || on.stop_deg() > 0 || !on.sheet.base().springs.at_vertices()) {
    return {};
  }
  const solver::ReleaseOptions release = release_of(on);
  const auto panels = solver::bend_panels(on.sheet, release, bending(on.design));
  if (!panels) return {};
  std::vector<PreloadedSprings> found;
  for (const double rate_n_per_mm : rates_n_per_mm) {
    solver::ReleaseOptions of_rate = release;
    solver::Springs& springs = of_rate.sheet.springs();
    springs.stiffness_n_per_mm = rate_n_per_mm;
    if (!springs.preload.is_any()) springs.preload.each_n = 1;
    const auto study = solver::study_preload(on.sheet, of_rate, *panels);
    if (!study) continue;
    found.push_back({rate_n_per_mm, study->best.preload_n, study->best.static_n_mm_per_mm});
  }
  return found;
}

}  // namespace misalign::search
