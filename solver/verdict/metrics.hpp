// What ranks the patterns that were accepted.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "solver/verdict/history.hpp"

namespace misalign::solver {

/// slope_min is taken from here on: closer to flat every slope goes to zero with the fold angle.
inline constexpr double kSlopeFrom_deg = kInactiveFrom_deg;

/// Of the definitions below: each run stores the version that it measured by; whoever changes a
/// definition raises it and adds a line to metric_age. 1: all but slope_between_min and bump_deg.
/// 2: these two, by cubics in the pilot's angle. 3: by cubics along the path, which see no bump
/// before a fold limit where there is none. 4: with miscut_margin.
inline constexpr int kMetricsVersion = 4;

struct MetricAge {
  int first;    ///< the version that it came with
  int present;  ///< the version since which it means what it does
};

/// By the name of its column.
MetricAge metric_age(std::string_view column);

/// Columns of the same names in the catalogue; everything over the samples up to D.
struct Metrics {
  int deploys_from_sample;
  double deploys_from_deg;
  double fold_limit_deg;
  double elongation_min, elongation_max;  ///< (L - L0) / L0 over all diagonals
  double stroke_min,
      stroke_max;  ///< largest |elongation| of the least and of the most used diagonal
  /// Least |L_k - L_(k-1)| / sample_deg from 5 degrees on; none if D lies below.
  std::optional<double> slope_min_mm_per_deg;
  /// Least rate of change in a diagonal's direction, at and between the samples from 5 degrees on:
  /// negative where there is a bump, or a turn just below D; none if D lies below.
  std::optional<double> slope_between_min_mm_per_deg;
  std::optional<double> bump_deg;  ///< where the first bump between two samples begins
  /// How far off the vertices may be cut, to first order, see MiscutMargin; none if the history was
  /// made without, or the path ends before the threshold.
  std::optional<double> miscut_margin_mm;
  double stretch_sq_mm2;      ///< sum of (L - L0)^2 at D
  double singular_value_min;  ///< square Jacobian, lengths in panel widths
  double residual_max;        ///< largest closure entry
  double isometry_error_mm;
  double kawasaki_defect_deg;  ///< largest |theta_1 + theta_3 - 180| over whole vertices
  int shifted_vertices;
  int increasing, decreasing;      ///< diagonals
  std::vector<double> elongation;  ///< of each diagonal at D
};

/// Metrics of a path with D >= 1 on samples of `sample_deg`.
Metrics measure(const PerforatedSheet& base, const FlatVertices& vertices_mm,
                const FoldingHistory& history, double sample_deg);

/// |theta_1 + theta_3 - 180 deg| (Kawasaki's condition), the largest over the vertices whose four
/// facets are all kept: zero where such a vertex can fold flat by itself.
double kawasaki_defect_deg(const PerforatedSheet& base, const FlatVertices& vertices_mm);

}  // namespace misalign::solver
