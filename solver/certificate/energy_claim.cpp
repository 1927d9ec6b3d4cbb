#include "solver/certificate/energy_claim.hpp"

#include <cassert>

namespace misalign::solver {
EnergyClaim::EnergyClaim(const Mechanism& mechanism, const Fill& fill) {
  assert(why_not_certifiable(fill, mechanism.springs) == nullptr);
  if (const auto* const all = std::get_if<Springs>(&fill)) {
    const Eigen::VectorXd preload_n = all->preload.forces_n(mechanism.diagonals);
    for (const Diagonal& diagonal : mechanism.diagonals) {
      springs.push_back({all->stiffness_n_per_mm, preload_n(std::ssize(springs))});
      for (const SingleSpring& single : all->single) {
        if (!single.is_on(diagonal)) continue;
        springs.back().rate_n_per_mm = single.stiffness_n_per_mm;
        springs.back().free_mm = single.free_mm;
      }
    }
    return;
  }
  const auto& all = std::get<RubberPlates>(fill);
  const double ratio = 1 / all.prestretch;
  plates.assign(mechanism.diagonals.size() / 2, {all.shear_mpa * all.thickness_mm, {ratio, ratio}});
  for (const CutOut& cut_out : all.cut_outs) {
    plates.at(static_cast<std::size_t>(cut_out.hole)).of_flat = cut_out.of_flat;
  }
}

bool EnergyClaim::is_relaxed_flat() const {
  return plates.empty() && std::ranges::all_of(springs, [](const ClaimedSpring& spring) {
           return spring.rate_n_per_mm == 0 || spring.is_relaxed();
         });
}

}  // namespace misalign::solver
