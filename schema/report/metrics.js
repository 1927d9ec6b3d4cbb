// The metrics of a candidate: what the program says of them, and what the page adds.
import { certified, count, degrees, fixed, number } from "./format.js";
import { words } from "./words.js";

const share = (value) => (value === null ? "–" : `${fixed(100 * value, 2)} %`);

const kWritten = {
  count,
  share,
  digits_3: (value) => number(value),
  digits_2: (value) => number(value, 2),
  decimals_1: (value) => fixed(value, 1),
  decimals_2: (value) => fixed(value, 2),
  whole_deg: degrees,
};

// label and unit head a column; `axis` is what a share is multiplied by on an axis (shares as %);
// `better` says which end comes first when it is sorted by, `none_is_best` that no value is better
// than any, `warns` which values are a bad sign; `may_be_unknown`: the column is left out where no
// row has a value.
const kStored = words.metrics.map(
  ({ written, unit, meaning, negative_is_bad, needs_a_campaign, ...rest }) => ({
    ...rest,
    unit: unit === "share" ? "%" : unit,
    ...(unit === "share" ? { axis: 100 } : {}),
    text: kWritten[written],
    about: meaning,
    warns: negative_is_bad ? (value) => value < 0 : undefined,
    of_campaign: needs_a_campaign,
  }),
);

// Known of copies, or of the springs of this report: none is a metric that the program stores.
const kYields = [
  {
    name: "yield",
    label: "yield",
    unit: "%",
    axis: 100,
    better: "more",
    may_be_unknown: true,
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
    may_be_unknown: true,
    text: share,
    about: "Lower end of the yield's 95 % interval: a few copies say little.",
  },
  {
    name: "yield_amplitude_mm",
    label: "yield at ±",
    unit: "mm",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v, 2),
    about: "How far off the vertices of the copies were cut, at most, in x and in y.",
  },
];
const kCertified = [
  {
    name: "certified_deg",
    label: "certified",
    unit: "deg",
    better: "more",
    may_be_unknown: true,
    text: certified,
    about:
      "Up to here `misalign certify` has proven that it folds in one way and every diagonal only grows or only shrinks, at every pilot fold angle.",
  },
];
// Of an optimising search, in the unit of its goal.
const kEnds = [
  {
    name: "start_value",
    label: "worth as drawn",
    unit: "",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v),
    about:
      "What the draw itself was worth, by the campaign’s goal (search.maximise), before it was made better.",
  },
  {
    name: "end_value",
    label: "worth",
    unit: "",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v),
    about:
      "What this sheet is worth by the campaign’s goal: N mm per mm of friction, or mm of margin against miscuts.",
  },
];
const kEnergy = [
  {
    name: "energy_n_mm",
    label: "energy",
    unit: "N mm",
    better: "more",
    text: (v) => number(v),
    about:
      "Stored at D by springs of the report’s stiffness k on all diagonals, relaxed when flat: k/2 times stretch². Not a column of the catalogue.",
  },
];
// Where `--deploy` and its like asked for them.
const kOfStudies = words.columns_of_studies
  .filter(({ name }) => name !== "energy_n_mm") // which the page has of itself
  .map(({ meaning, ...rest }) => ({
    ...rest,
    may_be_unknown: true,
    text: (v) => number(v),
    about: meaning,
  }));
/** Names of columns that a page has only where they were asked for. */
export const of_studies = new Set(kOfStudies.map(({ name }) => name));
const kAfter = {
  reverses_at_deg: [...kCertified, ...kEnds],
  miscut_margin_mm: kYields,
  stretch_sq_mm2: [...kEnergy, ...kOfStudies],
};

export const metrics = kStored.flatMap((metric) => [metric, ...(kAfter[metric.name] ?? [])]);

export const metric_of = Object.fromEntries(metrics.map((metric) => [metric.name, metric]));

/** A value with its unit: "4.36 %", "0.0123 mm/deg", "172°". */
export function with_unit(metric, value) {
  const text = metric.text(value ?? null);
  if (text === "–" || text.endsWith("%") || text.endsWith("°")) return text;
  if (metric.unit === "deg") return `${text}°`;
  return metric.unit ? `${text} ${metric.unit}` : text;
}

export const axis_title = (metric) => metric.label + (metric.unit ? ` (${metric.unit})` : "");
