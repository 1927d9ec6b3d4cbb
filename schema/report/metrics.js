// The metrics of a candidate: those of the program, and those that the page adds.
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

// `label` and `unit` head a column; `axis` is a share's factor on an axis (100: %); `better` says
// which values come first when sorted, `none_is_best` that no value is best; `warns` returns
// whether a value is bad; a column that `may_be_unknown` is left out where no row has a value; a
// `usual` one is an axis of the parallel coordinates where no columns are chosen.
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

// Metrics that the program does not store.
const kYields = [
  {
    name: "yield",
    usual: true,
    label: "yield",
    unit: "%",
    axis: 100,
    better: "more",
    may_be_unknown: true,
    text: share,
    about:
      "Share of miscut copies that deploy from the threshold, by `misalign tolerance`; at the amplitude that most candidates were studied with.",
  },
  {
    name: "yield_low",
    label: "yield low",
    unit: "%",
    axis: 100,
    better: "more",
    may_be_unknown: true,
    text: share,
    about: "Lower end of the yield's 95 % interval.",
  },
  {
    name: "yield_amplitude_mm",
    label: "cutting error ±",
    unit: "mm",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v, 2),
    about: "Largest cutting error of the copies' vertices, in x and in y.",
  },
];
const kCertified = [
  {
    name: "certified_deg",
    usual: true,
    label: "certified",
    unit: "deg",
    better: "more",
    may_be_unknown: true,
    text: certified,
    about:
      "Certified angle of `misalign certify`: up to it the sheet provably folds in one way and every diagonal is monotone, also between samples.",
  },
];
// Values of an optimising search, in the unit of its objective.
const kEnds = [
  {
    name: "start_value",
    usual: true,
    label: "objective at start",
    unit: "",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v),
    about: "The campaign’s objective (search.maximise) of the draw, before its ascent.",
  },
  {
    name: "end_value",
    usual: true,
    label: "objective",
    unit: "",
    better: "more",
    may_be_unknown: true,
    text: (v) => number(v),
    about:
      "The campaign’s objective (search.maximise) of this sheet: N mm/mm for friction, mm for a margin against miscuts.",
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
      "Strain energy at D of springs with the report’s stiffness k on all diagonals, relaxed when flat: k/2 times stretch². Not a column of the catalogue.",
  },
];
// Columns that options such as `--deploy` add.
const kOfStudies = words.columns_of_studies
  .filter(({ name }) => name !== "energy_n_mm") // the page computes it
  .map(({ meaning, ...rest }) => ({
    ...rest,
    may_be_unknown: true,
    text: (v) => number(v),
    about: meaning,
  }));
/** Names of columns that a page has only on request. */
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
