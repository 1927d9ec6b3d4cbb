// The search method "optimise", from each draw that is accepted, or sheet that a population finds,
// on to better sheets; and what `misalign optimise` asks as it does.
#pragma once

#include <cstdint>
#include <optional>

#include "schema/campaign/optimise_bounds.hpp"

namespace misalign::schema {

/// The request that a campaign's starts and single sheets have alike. Its initial values are the
/// released defaults of campaigns: they never change.
struct OptimiseRequest {
  const solver::Goal* goal = solver::goal_named("critical_friction_n_mm_per_mm");
  OptimiseBounds bounds = {};
  bool ternary = false;                  ///< vertices are shifted by nothing or the amplitude
  std::optional<double> grid_mm = {};    ///< they are shifted by whole multiples of it
  double least_slope_mm_per_deg = 1e-3;  ///< as solver::OptimiseOptions
  std::uint32_t most_steps = 200;

  bool operator==(const OptimiseRequest&) const = default;
};

/// Everything that decides where a start ends: it is part of the identity, whatever the campaign's
/// design says.
struct Optimisation : OptimiseRequest {
  std::optional<double> from_deg;  ///< pilot angle from which it is let go; frictions need one
  double stiffness_n_per_mm = 50;
  double preload_n = 0;
  /// Where a population finds the starts: so many of its sheets, those that it meets first.
  std::uint32_t starts_of_population = 16;

  bool operator==(const Optimisation&) const = default;
};

/// Reads its keys of the part "search" of a campaign with this threshold.
Optimisation read_optimisation(ObjectReader& reader, double threshold_deg);
/// What an optimisation that is asked for lacks.
void check_optimisation(ObjectReader& reader, const Optimisation& optimisation);

/// Every key of its own, with draws as starts.
Json optimisation_json(const Optimisation& optimisation);

}  // namespace misalign::schema
