// Computes the metrics that rank accepted patterns.
#pragma once

#include <optional>
#include <vector>

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
inline constexpr int kMetricsVersion = 7;

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
  int shifted_vertices;
  int increasing, decreasing;
  std::vector<double> elongation;  ///< per diagonal at D; not in the table
};

/// Metrics of a path with D >= 1 on samples of `sample_deg`.
Metrics measure(const PerforatedSheet& base, const FlatVertices& vertices_mm,
                const PathRecord& record, double sample_deg);

/// |theta_1 + theta_3 - 180 deg| (Kawasaki's condition), the largest over vertices whose four
/// facets are all kept: zero if all these are flat-foldable.
double kawasaki_defect_deg(const PerforatedSheet& base, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
