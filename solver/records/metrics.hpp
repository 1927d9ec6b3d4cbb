// Computes the metrics that rank accepted patterns.
#pragma once

#include <optional>
#include <vector>

#include "solver/model/model.hpp"
#include "solver/records/path_record.hpp"

namespace misalign::solver {

/// Pilot angle from which slope_min is taken: closer to flat every slope goes to zero with the fold
/// angle.
inline constexpr double kSlopeFrom_deg = kInactiveFrom_deg;

/// Version of the definitions below, which each run stores; whoever changes a definition raises it
/// and describes it in schema/catalogue/metric_table. 1: all but slope_between_min and bump_deg. 2:
/// these two, by cubics in the pilot's angle. 3: by cubics along the path, which see no bump before
/// a fold limit where there is none. 4: with miscut_margin. 5: fold_limit_deg of paths that end at
/// 180 degrees, where the equations are singular, is 180. 6: with reverses_at; slope_between_min
/// and bump_deg of the path as a function; singular_value_min, residual_max and isometry_error over
/// the states that were solved. 7: slope_between_min and reverses_at where they are solved,
/// whatever followed the path; bump_deg is that of the fault, too.
/// 8: with energy_deploys_from_sample and critical_friction.
inline constexpr int kMetricsVersion = 8;

/// Metrics over the samples up to D. schema/catalogue/metric_table has their units, their meanings
/// and the cases without value.
struct Metrics {
  int deploys_from_sample;
  double deploys_from_deg;
  double fold_limit_deg;
  double elongation_min, elongation_max;
  double stroke_min, stroke_max;
  std::optional<double> slope_min_mm_per_deg;
  std::optional<double> slope_between_min_mm_per_deg;
  std::optional<double> bump_deg;
  std::optional<double> reverses_at_deg;
  std::optional<double> miscut_margin_mm;  ///< also none if the history has none
  double stretch_sq_mm2;
  double singular_value_min;
  double residual_max;
  double isometry_error_mm;
  double kawasaki_defect_deg;
  /// D and critical friction of the campaign's filling, or else of springs of the paper's stiffness
  /// relaxed flat. This D may lie beyond that of the diagonals; the friction is from the model's
  /// threshold, none without.
  int energy_deploys_from_sample;
  double energy_deploys_from_deg;
  std::optional<double> critical_friction_n_mm_per_mm;
  int shifted_vertices;
  int increasing, decreasing;
  std::vector<double> elongation;  ///< per diagonal at D; not in the table
};

/// Metrics of a path with D >= 1 of the model's sheet with these vertices. Under the energy
/// criterion diagonals may reverse, and the two slopes and the miscut margin have no value.
Metrics measure(const Model& model, const FlatVertices& vertices_mm, const PathRecord& record);

/// |theta_1 + theta_3 - 180 deg| (Kawasaki's condition), the largest over vertices whose four
/// facets are all kept: zero if all these are flat-foldable.
double kawasaki_defect_deg(const PerforatedSheet& base, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
