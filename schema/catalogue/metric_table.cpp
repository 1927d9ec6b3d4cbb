// Lists the metrics. A new one needs a member of Metrics and its formula (solver/records/metrics),
// a row here, and its column (schema/catalogue.sql, and a migration). Messages between ranks, rows,
// JSON, comparisons and the report follow from the table.
#include "schema/catalogue/metric_table.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

constexpr ValueRange kPositive{.least = 0, .above_least = true}, kNotNegative{.least = 0};
constexpr auto kWidths = Allowance::Of::width_mm;

// An allowance is about 10 w, where w is the largest difference on 1,008 candidates between the
// lanes and the reference, which has dense matrices and other step rules.
constexpr Allowance kShares{.absolute = 3e-11};  // w = 3e-12

constexpr MetricEntry kMetrics[] = {
    {.name = "deploys_from_sample",
     .member = &solver::Metrics::deploys_from_sample,
     .unit = "count",
     .meaning = "D as a number of samples; no sample up to it has a fault.",
     .range = {.least = 1}},
    {.name = "deploys_from_deg",
     .member = &solver::Metrics::deploys_from_deg,
     .unit = "deg",
     .meaning =
         "D: the largest pilot fold angle up to which no sample has a fault. The path exists, "
         "no crease is over-folded, mountains and valleys stay, and every diagonal is monotone.",
     .range = kPositive,
     .allowance = {.relative = 1e-15},  // a product of two exact numbers
     .label = "deploys from",
     .written = "whole_deg",
     .usual = true},
    {.name = "fold_limit_deg",
     .member = &solver::Metrics::fold_limit_deg,
     .unit = "deg",
     .meaning =
         "Largest pilot fold angle that the sheet reaches, or the end of the path. A misaligned "
         "sheet generally cannot fold flat.",
     .range = kPositive,
     .allowance = {.absolute = 1e-6},  // located to 1e-7
     .age = {1, 5},
     .label = "fold limit",
     .written = "decimals_2"},
    {.name = "miscut_margin_mm",
     .member = &solver::Metrics::miscut_margin_mm,
     .unit = "mm",
     .meaning =
         "Least distance, to first order, to a sheet with a diagonal that stalls over some "
         "20° below the threshold: the root of the sum of squares of the vertices' errors in x "
         "and y. No other metric predicts the yield of miscut copies as well. None if the "
         "path ends before the threshold, or energy judges draws.",
     .range = kNotNegative,
     // w = 2.7e-12 widths between dense and stored states and factors: 3,497 candidates of
     // miura-4x4 from 175 degrees, where gradients are large near fold limits. From 150 to 170
     // degrees w = 1.7e-13: 195 of miura-6x6, 334 of ring-6x6, 500 of miura-4x4. The allowance is
     // absolute: a small margin is a small difference of lengths.
     .allowance = {.absolute = 3e-11, .of = kWidths},
     .age = {4, 4},
     .schema_since = 4,
     .label = "miscut margin",
     .needs_a_campaign = true,
     .usual = true},
    {.name = "slope_min_mm_per_deg",
     .member = &solver::Metrics::slope_min_mm_per_deg,
     .unit = "mm/deg",
     .meaning =
         "Monotonicity margin: least change of any diagonal between neighbouring samples, per "
         "degree, from 5° to D. None when D lies below 5°, or energy judges draws.",
     .range = kNotNegative,
     .allowance = {.absolute = 1e-12, .of = Allowance::Of::width_mm_per_sample},  // w = 8e-14
     .label = "least slope",
     .usual = true},
    {.name = "slope_between_min_mm_per_deg",
     .member = &solver::Metrics::slope_between_min_mm_per_deg,
     .unit = "mm/deg",
     .meaning = "Least rate of change of any diagonal in its direction, at and between the samples "
                "from 5° to D. Negative if a diagonal reverses between two samples. None when D "
                "lies below 6°, or energy judges draws.",
     // The error of a rate of change, which follows from the tangent, is the closure error over the
     // singular value: 1e-12 / 1e-4 rad per rad.
     .allowance = {.absolute = 1e-8 / 57, .of = kWidths},
     .age = {2, 7},
     .schema_since = 2,
     .label = "slope between",
     .negative_is_bad = true},
    {.name = "bump_deg",
     .member = &solver::Metrics::bump_deg,
     .unit = "deg",
     .meaning = "Pilot fold angle of the first bump: a diagonal that reverses twice between two "
                "samples, up to D or as the first fault. None without a bump.",
     .range = {.least = 0, .most = 180},
     .allowance = {.absolute = 1e-3},  // root of a rate of change
     .age = {2, 7},
     .schema_since = 2,
     .label = "bump",
     .written = "decimals_1",
     .none_is_best = true},
    {.name = "reverses_at_deg",
     .member = &solver::Metrics::reverses_at_deg,
     .unit = "deg",
     .meaning = "Pilot fold angle where a diagonal first reverses, at or between the samples, even "
                "beyond D. None if no diagonal reverses up to the last sample of the path.",
     .range = {.least = 0, .most = 180},
     .allowance = {.absolute = 1e-6},  // from a nearby solution and one Newton step
     .age = {6, 7},
     .schema_since = 5,
     .label = "reversal",
     .written = "decimals_2"},
    {.name = "stroke_min",
     .member = &solver::Metrics::stroke_min,
     .unit = "share",
     .meaning = "Least stroke of any diagonal: its largest change of length up to D, as a share of "
                "its flat length.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "least stroke",
     .usual = true},
    {.name = "stroke_max",
     .member = &solver::Metrics::stroke_max,
     .unit = "share",
     .meaning = "Largest stroke of any diagonal, which an actuator must reach: its largest change "
                "of length up to D, as a share of its flat length.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "largest stroke",
     .less_is_better = true,
     .usual = true},
    {.name = "elongation_min",
     .member = &solver::Metrics::elongation_min,
     .unit = "share",
     .meaning =
         "Least elongation (L − L₀)/L₀ of any diagonal up to D, as a share of the flat length; "
         "negative if a diagonal shortens.",
     .range = {.least = -1, .most = 0, .above_least = true},
     .allowance = kShares,
     .label = "least elongation"},
    {.name = "elongation_max",
     .member = &solver::Metrics::elongation_max,
     .unit = "share",
     .meaning =
         "Largest elongation (L − L₀)/L₀ of any diagonal up to D, as a share of the flat length.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "largest elongation",
     .less_is_better = true},
    {.name = "stretch_sq_mm2",
     .member = &solver::Metrics::stretch_sq_mm2,
     .unit = "mm²",
     .meaning =
         "Sum of (L − L₀)² over all diagonals at D. Half of it times the springs' stiffness is "
         "their strain energy.",
     .range = kNotNegative,
     .allowance = {.relative = 2e-9},  // w = 1.4e-10
     .label = "stretch²",
     .usual = true},
    {.name = "energy_deploys_from_deg",
     .member = &solver::Metrics::energy_deploys_from_deg,
     .unit = "deg",
     .meaning = "D by energy: the largest pilot fold angle down from which the energy of "
                "the campaign's filling falls at every sample to flat; by springs of 50 N/mm, "
                "relaxed flat, where the campaign judges diagonals.",
     .range = kNotNegative,
     .allowance = {.relative = 1e-15},  // a product of two exact numbers
     .age = {8, 8},
     .schema_since = 11,
     .label = "D by energy",
     .written = "whole_deg"},
    {.name = "energy_friction_n_mm_per_mm",
     .member = &solver::Metrics::critical_friction_n_mm_per_mm,
     .unit = "N mm/mm",
     .meaning = "Critical friction from the threshold by that filling, with rigid panels: dry "
                "friction of the creases with which the sheet, released there, still reaches "
                "flat. None if it does not by energy alone.",
     .range = kNotNegative,
     // A quotient of differences over one sample or more, with the errors of the path as a
     // function: up to 4e-6 in the tests' campaigns.
     .allowance = {.relative = 5e-5},
     .age = {8, 8},
     .schema_since = 11,
     .label = "friction from threshold",
     .needs_a_campaign = true,
     .usual = true},
    {.name = "shifted_vertices",
     .member = &solver::Metrics::shifted_vertices,
     .unit = "count",
     .meaning = "Number of shifted vertices.",
     .range = kNotNegative,
     .label = "shifted",
     .less_is_better = true,
     .usual = true},
    {.name = "increasing",
     .member = &solver::Metrics::increasing,
     .unit = "count",
     .meaning = "Number of diagonals that are longer at D than flat.",
     .range = kNotNegative,
     .label = "increasing"},
    {.name = "decreasing",
     .member = &solver::Metrics::decreasing,
     .unit = "count",
     .meaning = "Number of diagonals that are not longer at D than flat.",
     .range = kNotNegative,
     .label = "decreasing"},
    {.name = "kawasaki_defect_deg",
     .member = &solver::Metrics::kawasaki_defect_deg,
     .unit = "deg",
     .meaning =
         "Largest |θ₁ + θ₃ − 180°| over the vertices with four panels; zero if each of them is "
         "flat-foldable alone.",
     .range = kNotNegative,
     .allowance = {.absolute = 1e-11},  // a sum of two angles, each to 1e-13
     .label = "Kawasaki defect",
     .less_is_better = true},
    {.name = "singular_value_min",
     .member = &solver::Metrics::singular_value_min,
     .unit = "",
     .meaning = "Smallest singular value of the square Jacobian up to D (lengths in panel widths, "
                "angles in radians); small where a second motion is near.",
     .range = kNotNegative,
     .allowance = {.relative = 1e-5},  // the iteration ends at changes of 1e-6
     .label = "singular value"},
    {.name = "residual_max",
     .member = &solver::Metrics::residual_max,
     .unit = "",
     .meaning = "Largest closure error of any loop up to D, in radians or panel widths.",
     .range = kNotNegative,
     .allowance = {.absolute = 1e-12},  // rounding, up to the closure tolerance
     .label = "residual",
     .written = "digits_2",
     .less_is_better = true},
    {.name = "isometry_error_mm",
     .member = &solver::Metrics::isometry_error_mm,
     .unit = "mm",
     .meaning = "Largest change of any panel's edge or diagonal up to D, computed from vertex "
                "coordinates alone; zero if panels stay rigid.",
     .range = kNotNegative,
     .allowance = {.absolute = 2e-11, .of = kWidths},  // rounding: w = 1.6e-12 widths
     .label = "isometry error",
     .written = "digits_2",
     .less_is_better = true},
};

}  // namespace

bool Allowance::allows(double a, double b, double width_mm, double sample_deg) const {
  double scale = 1;
  if (of == Of::width_mm) scale = width_mm;
  if (of == Of::width_mm_per_sample) scale = width_mm / sample_deg;
  return std::abs(a - b) <= absolute * scale + relative * std::abs(b);
}

std::span<const MetricEntry> metric_table() { return kMetrics; }

const MetricEntry* find_metric(std::string_view column) {
  const auto at = std::ranges::find(kMetrics, column, &MetricEntry::name);
  return at == std::end(kMetrics) ? nullptr : at;
}

MetricAge metric_age(std::string_view column) {
  const MetricEntry* metric = find_metric(column);
  return metric ? metric->age : MetricAge{};
}

}  // namespace misalign::schema
