// The metrics of a candidate: name in the catalogue, words, unit, how a value is written, what it means.
import { count, degrees, fixed, number } from "./format.js";

const share = (value) => (value === null ? "–" : `${fixed(100 * value, 2)} %`);

// label and unit head a column; `axis` is what a share is multiplied by on an axis (shares as %);
// `better` says which end comes first when it is sorted by, `none_is_best` that no value is better
// than any, `warns` which values are a bad sign.
export const metrics = [
  {
    name: "deploys_from_deg",
    label: "deploys from",
    unit: "deg",
    better: "more",
    text: degrees,
    about:
      "D: the pilot fold angle up to which everything holds at every sample. The path exists, no crease is over-folded, mountains and valleys stay, and every diagonal keeps its direction.",
  },
  {
    name: "fold_limit_deg",
    label: "fold limit",
    unit: "deg",
    better: "more",
    text: (v) => fixed(v, 2),
    about:
      "Pilot fold angle where the pilot crease turns round: a misaligned sheet generally cannot fold flat. Or the end of the path.",
  },
  {
    name: "miscut_margin_mm",
    label: "miscut margin",
    unit: "mm",
    better: "more",
    text: (v) => number(v),
    of_campaign: true, // it looks up to the campaign's threshold
    about:
      "The least distance, to first order, to a sheet of which some diagonal stalls on some stretch of 20° up to the threshold (root of the sum of squares of all vertices' errors). Of all that is known without trying it foretells best how many miscut copies deploy.",
  },
  {
    name: "yield",
    label: "yield",
    unit: "%",
    axis: 100,
    better: "more",
    text: share,
    about:
      "Share of miscut copies that deploy from the threshold, where `misalign tolerance` has tried; at the amplitude that most candidates were tried with.",
  },
  {
    name: "yield_low",
    label: "yield low",
    unit: "%",
    axis: 100,
    better: "more",
    text: share,
    about: "Lower end of the yield's 95 % interval: a few copies say little.",
  },
  {
    name: "yield_amplitude_mm",
    label: "yield at ±",
    unit: "mm",
    better: "more",
    text: (v) => number(v, 2),
    about: "How far off the vertices of the copies were cut, at most, in x and in y.",
  },
  {
    name: "slope_min_mm_per_deg",
    label: "slope min",
    unit: "mm/deg",
    better: "more",
    text: (v) => number(v),
    about:
      "Margin of monotonicity: least change of any diagonal from one sample to the next, from 5° to D.",
  },
  {
    name: "slope_between_min_mm_per_deg",
    label: "slope between",
    unit: "mm/deg",
    better: "more",
    warns: (v) => v < 0,
    text: (v) => number(v),
    about:
      "Least rate of change at and between the samples from 5° on (slope min: steps, of which the first ends at 5°). Negative where a diagonal goes back between two samples.",
  },
  {
    name: "bump_deg",
    label: "bump",
    unit: "deg",
    better: "more",
    none_is_best: true,
    text: (v) => fixed(v, 1),
    about:
      "Pilot fold angle where a diagonal first goes back and on again between two samples; – where it never does.",
  },
  {
    name: "stroke_min",
    label: "stroke min",
    unit: "%",
    better: "more",
    axis: 100,
    text: share,
    about:
      "Largest change of length of the least used diagonal, as a share of its flat length: 0.05 is 5 %.",
  },
  {
    name: "stroke_max",
    label: "stroke max",
    unit: "%",
    better: "less",
    axis: 100,
    text: share,
    about:
      "Largest change of length of the most used diagonal, as a share of its flat length: what an actuator must be able to do.",
  },
  {
    name: "elongation_min",
    label: "shortest",
    unit: "%",
    better: "more",
    axis: 100,
    text: share,
    about:
      "Least elongation (L − L₀)/L₀ over all diagonals up to D: a share of the flat length, negative where a diagonal gets shorter.",
  },
  {
    name: "elongation_max",
    label: "longest",
    unit: "%",
    better: "less",
    axis: 100,
    text: share,
    about: "Largest elongation (L − L₀)/L₀ over all diagonals up to D: a share of the flat length.",
  },
  {
    name: "stretch_sq_mm2",
    label: "stretch²",
    unit: "mm²",
    better: "more",
    text: (v) => number(v),
    about: "Sum of (L − L₀)² over all diagonals at D.",
  },
  {
    name: "energy_n_mm",
    label: "energy",
    unit: "N mm",
    better: "more",
    text: (v) => number(v),
    about:
      "Stored at D by springs of the report’s stiffness k on all diagonals: k/2 times stretch². Not a column of the catalogue.",
  },
  {
    name: "shifted_vertices",
    label: "shifted",
    unit: "",
    better: "less",
    text: count,
    about: "Vertices that are shifted.",
  },
  {
    name: "increasing",
    label: "increasing",
    unit: "",
    better: "more",
    text: count,
    about: "Diagonals that are longer at D than flat.",
  },
  {
    name: "decreasing",
    label: "decreasing",
    unit: "",
    better: "more",
    text: count,
    about: "Diagonals that are shorter at D than flat.",
  },
  {
    name: "kawasaki_defect_deg",
    label: "Kawasaki",
    unit: "deg",
    better: "less",
    text: (v) => number(v),
    about:
      "Largest |θ₁ + θ₃ − 180°| over the vertices with four panels: zero where such a vertex folds flat by itself.",
  },
  {
    name: "singular_value_min",
    label: "singular value",
    unit: "",
    better: "more",
    text: (v) => number(v),
    about:
      "Smallest singular value of the square Jacobian up to D: how far from a second way to move.",
  },
  {
    name: "residual_max",
    label: "residual",
    unit: "",
    better: "less",
    text: (v) => number(v, 2),
    about: "Largest closure error of any loop up to D, in radians or panel widths.",
  },
  {
    name: "isometry_error_mm",
    label: "isometry error",
    unit: "mm",
    better: "less",
    text: (v) => number(v, 2),
    about:
      "Largest change of any panel's edge or diagonal up to D, from the vertex coordinates alone.",
  },
];

export const metric_of = Object.fromEntries(metrics.map((metric) => [metric.name, metric]));

/** A value with its unit: "4.36 %", "0.0123 mm/deg", "172°". */
export function with_unit(metric, value) {
  const text = metric.text(value ?? null);
  if (text === "–" || text.endsWith("%") || text.endsWith("°")) return text;
  if (metric.unit === "deg") return `${text}°`;
  return metric.unit ? `${text} ${metric.unit}` : text;
}

export const axis_title = (metric) => metric.label + (metric.unit ? ` (${metric.unit})` : "");
