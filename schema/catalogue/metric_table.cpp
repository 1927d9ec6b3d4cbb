// To add a metric: a member of Metrics and its formula (solver/records/metrics), a row here, its
// column (schema/catalogue.sql, and a migration). Messages between ranks, rows, JSON, comparisons
// and the report follow.
#include "schema/catalogue/metric_table.hpp"

#include <algorithm>
#include <cmath>

namespace misalign::schema {
namespace {

constexpr ValueRange kPositive{.least = 0, .above_least = true}, kNotNegative{.least = 0};
constexpr auto kWidths = Allowance::Of::width_mm;

// Where the lanes, and dense matrices with step rules of their own (the reference's), differed by w
// at most on 1,008 candidates, the allowance is about 10 w.
constexpr Allowance kShares{.absolute = 3e-11};  // w = 3e-12

constexpr MetricEntry kMetrics[] = {
    {.name = "deploys_from_sample",
     .member = &solver::Metrics::deploys_from_sample,
     .unit = "count",
     .meaning = "D as a count of samples: every sample up to it is in order.",
     .range = {.least = 1}},
    {.name = "deploys_from_deg",
     .member = &solver::Metrics::deploys_from_deg,
     .unit = "deg",
     .meaning = "D: the pilot fold angle up to which everything holds at every sample. The path "
                "exists, no crease is over-folded, mountains and valleys stay, and every diagonal "
                "keeps its direction.",
     .range = kPositive,
     .allowance = {.relative = 1e-15},  // a product of two exact numbers
     .label = "deploys from",
     .written = "whole_deg"},
    {.name = "fold_limit_deg",
     .member = &solver::Metrics::fold_limit_deg,
     .unit = "deg",
     .meaning = "Pilot fold angle where the pilot crease reaches its fold limit: a misaligned "
                "sheet generally cannot fold flat. Or the end of the path.",
     .range = kPositive,
     .allowance = {.absolute = 1e-6},  // located to 1e-7
     .age = {1, 5},
     .label = "fold limit",
     .written = "decimals_2"},
    {.name = "miscut_margin_mm",
     .member = &solver::Metrics::miscut_margin_mm,
     .unit = "mm",
     .meaning = "The least distance, to first order, to a sheet of which some diagonal stalls on "
                "some stretch of 20° up to the threshold (root of the sum of squares of all "
                "vertices' errors in x and y). Of all that is known without trying it foretells "
                "best how many miscut copies deploy. None if the path ends before the threshold.",
     .range = kNotNegative,
     // w = 2.7e-12 widths, states and factors dense against stored: 3,497 candidates of miura-4x4
     // from 175 degrees, near whose fold limits gradients are large. From 150 to 170 degrees
     // w = 1.7e-13: 195 of miura-6x6, 334 of ring-6x6, 500 of miura-4x4. No share of it: a small
     // margin is a small difference of lengths.
     .allowance = {.absolute = 3e-11, .of = kWidths},
     .age = {4, 4},
     .schema_since = 4,
     .label = "miscut margin",
     .needs_a_campaign = true},
    {.name = "slope_min_mm_per_deg",
     .member = &solver::Metrics::slope_min_mm_per_deg,
     .unit = "mm/deg",
     .meaning = "Margin of monotonicity: least change of any diagonal from one sample to the next, "
                "over the degrees between them, from 5° to D. None when D lies below 5°.",
     .range = kNotNegative,
     .allowance = {.absolute = 1e-12, .of = Allowance::Of::width_mm_per_sample},  // w = 8e-14
     .label = "slope min"},
    {.name = "slope_between_min_mm_per_deg",
     .member = &solver::Metrics::slope_between_min_mm_per_deg,
     .unit = "mm/deg",
     .meaning = "Least rate of change of any diagonal in its direction, at and between the samples "
                "from 5° on (slope min: steps, of which the first ends at 5°). Negative where a "
                "diagonal goes back between two samples. None when D lies below 6°.",
     // Rates of change, from the tangent: its error is the closure's over the singular value,
     // 1e-12 / 1e-4 radians a radian.
     .allowance = {.absolute = 1e-8 / 57, .of = kWidths},
     .age = {2, 7},
     .schema_since = 2,
     .label = "slope between",
     .negative_is_bad = true},
    {.name = "bump_deg",
     .member = &solver::Metrics::bump_deg,
     .unit = "deg",
     .meaning = "Pilot fold angle where a diagonal first goes back and on again between two "
                "samples, up to D or as the fault that ends it; none where none does.",
     .range = {.least = 0, .most = 180},
     .allowance = {.absolute = 1e-3},  // known by the root of what a rate of change is
     .age = {2, 7},
     .schema_since = 2,
     .label = "bump",
     .written = "decimals_1",
     .none_is_best = true},
    {.name = "reverses_at_deg",
     .member = &solver::Metrics::reverses_at_deg,
     .unit = "deg",
     .meaning = "Pilot fold angle where a diagonal first turns back, at or between the samples, D "
                "or not; none where none does up to the last sample of the path.",
     .range = {.least = 0, .most = 180},
     .allowance = {.absolute = 1e-6},  // by a solution next to it, and the step that its slope asks
     .age = {6, 7},
     .schema_since = 5,
     .label = "reverses",
     .written = "decimals_2"},
    {.name = "stroke_min",
     .member = &solver::Metrics::stroke_min,
     .unit = "share",
     .meaning =
         "Largest change of length of the least used diagonal, as a share of its flat length.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "stroke min"},
    {.name = "stroke_max",
     .member = &solver::Metrics::stroke_max,
     .unit = "share",
     .meaning = "Largest change of length of the most used diagonal, as a share of its flat "
                "length: what an actuator must be able to do.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "stroke max",
     .less_is_better = true},
    {.name = "elongation_min",
     .member = &solver::Metrics::elongation_min,
     .unit = "share",
     .meaning = "Least elongation (L − L₀)/L₀ over all diagonals up to D: a share of the flat "
                "length, negative where a diagonal gets shorter.",
     .range = {.least = -1, .most = 0, .above_least = true},
     .allowance = kShares,
     .label = "shortest"},
    {.name = "elongation_max",
     .member = &solver::Metrics::elongation_max,
     .unit = "share",
     .meaning =
         "Largest elongation (L − L₀)/L₀ over all diagonals up to D: a share of the flat length.",
     .range = kNotNegative,
     .allowance = kShares,
     .label = "longest",
     .less_is_better = true},
    {.name = "stretch_sq_mm2",
     .member = &solver::Metrics::stretch_sq_mm2,
     .unit = "mm²",
     .meaning = "Sum of (L − L₀)² over all diagonals at D; half of it times a stiffness is the "
                "springs' energy.",
     .range = kNotNegative,
     .allowance = {.relative = 2e-9},  // w = 1.4e-10
     .label = "stretch²"},
    {.name = "shifted_vertices",
     .member = &solver::Metrics::shifted_vertices,
     .unit = "count",
     .meaning = "Vertices that are shifted.",
     .range = kNotNegative,
     .label = "shifted",
     .less_is_better = true},
    {.name = "increasing",
     .member = &solver::Metrics::increasing,
     .unit = "count",
     .meaning = "Diagonals that are longer at D than flat.",
     .range = kNotNegative,
     .label = "increasing"},
    {.name = "decreasing",
     .member = &solver::Metrics::decreasing,
     .unit = "count",
     .meaning = "Diagonals that are not longer at D than flat.",
     .range = kNotNegative,
     .label = "decreasing"},
    {.name = "kawasaki_defect_deg",
     .member = &solver::Metrics::kawasaki_defect_deg,
     .unit = "deg",
     .meaning = "Largest |θ₁ + θ₃ − 180°| over the vertices with four panels: zero where such a "
                "vertex folds flat by itself.",
     .range = kNotNegative,
     .allowance = {.absolute = 1e-11},  // a sum of two angles, each to 1e-13
     .label = "Kawasaki",
     .less_is_better = true},
    {.name = "singular_value_min",
     .member = &solver::Metrics::singular_value_min,
     .unit = "",
     .meaning = "Smallest singular value of the square Jacobian up to D (lengths in panel widths, "
                "angles in radians): how far from a second way to move.",
     .range = kNotNegative,
     .allowance = {.relative = 1e-5},  // its iteration ends at changes of 1e-6
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
     .meaning = "Largest change of any panel's edge or diagonal up to D, from the vertex "
                "coordinates alone.",
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
