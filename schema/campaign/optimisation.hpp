// Defines the search method "optimise", with ascents from accepted draws or from sheets of
// populations, and the same request of `misalign optimise`.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/campaign/optimise_bounds.hpp"

namespace misalign::schema {

/// Request of an ascent from a campaign's start or a single sheet. Its initial values are released
/// defaults of campaigns and never change.
struct OptimiseRequest {
  const solver::Goal* goal = solver::goal_named("critical_friction_n_mm_per_mm");
  OptimiseBounds bounds = {};
  bool ternary = false;                  ///< vertices are shifted by -amplitude, 0 or +amplitude
  std::optional<double> grid_mm = {};    ///< shifts are whole multiples of it
  double least_slope_mm_per_deg = 1e-3;  ///< like solver::OptimiseOptions
  std::uint32_t most_steps = 200;

  bool operator==(const OptimiseRequest&) const = default;
};

/// Everything that determines the optimum of a start: part of the identity, whatever the campaign's
/// design says.
struct Optimisation : OptimiseRequest {
  std::optional<double> from_deg;  ///< release angle, which frictions need
  double stiffness_n_per_mm = 50;
  double preload_n = 0;
  /// Number of starts from each population, its first sheets.
  std::uint32_t starts_of_population = 16;

  bool operator==(const Optimisation&) const = default;
};

/// Reads the keys of optimise in the part "search" of a campaign with this threshold.
Optimisation read_optimisation(ObjectReader& reader, double threshold_deg);
/// Checks that the request of an optimisation is complete.
void check_optimisation(ObjectReader& reader, const Optimisation& optimisation);

/// Returns every key of optimise alone, with draws as starts.
Json optimisation_json(const Optimisation& optimisation);

}  // namespace misalign::schema
