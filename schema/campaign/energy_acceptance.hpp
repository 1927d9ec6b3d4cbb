// Defines acceptance by the total energy of a filling: "by": "energy" in the part "accept" of a
// campaign.
#pragma once

#include <optional>

#include "schema/files/input.hpp"
#include "solver/pattern/perforation.hpp"
#include "solver/verdict/criterion.hpp"

namespace misalign::schema {

/// solver::EnergyCriterion without its threshold, which is the campaign's. The member initializers
/// are released defaults and never change.
struct EnergyAcceptance {
  /// Springs of one rate, or plates of one cut-out, relaxed flat apart from preload or pre-stretch.
  solver::Fill fill = solver::Springs{};
  std::optional<double> least_friction_n_mm_per_mm = {}, least_moment_n_mm = {};

  solver::EnergyCriterion criterion(int threshold_sample) const {
    return {fill, threshold_sample, least_friction_n_mm_per_mm.value_or(0),
            least_moment_n_mm.value_or(0)};
  }
};

/// Returns the filling whose energy judges; none if diagonals do.
inline std::optional<solver::Fill> fill_of(const std::optional<EnergyAcceptance>& energy) {
  return energy ? std::optional<solver::Fill>(energy->fill) : std::nullopt;
}

/// Reads "by", "fill" and the margins of the part "accept"; none if all diagonals must be monotone.
std::optional<EnergyAcceptance> read_energy_acceptance(ObjectReader& accept,
                                                       const solver::PerforatedSheet& base);

/// Returns every key of it, null for margins that are not demanded.
Json energy_acceptance_json(const std::optional<EnergyAcceptance>& energy);

}  // namespace misalign::schema
