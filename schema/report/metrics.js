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

/** A metric that the program does not store. */
const added = (name, label, about, more) => ({
  ...{ name, label, about, unit: "", better: "more", may_be_unknown: true },
  text: (v) => number(v),
  ...more,
});
const kShare = { unit: "%", axis: 100, text: share };

const kYields = [
  added(
    "yield",
    "yield",
    "Share of miscut copies that deploy from the threshold, by `misalign tolerance`; at the amplitude that most candidates were studied with.",
    { ...kShare, usual: true },
  ),
  added("yield_low", "yield low", "Lower end of the yield's 95 % interval.", kShare),
  added(
    "yield_amplitude_mm",
    "cutting error ±",
    "Largest cutting error of the copies' vertices, in x and in y.",
    { unit: "mm", text: (v) => number(v, 2) },
  ),
];
const kCertified = [
  added(
    "certified_deg",
    "certified",
    "Certified angle of `misalign certify`: up to it the sheet provably folds in one way and every diagonal is monotone, also between samples.",
    { unit: "deg", text: certified, usual: true },
  ),
];
// Values of an optimising search, in the unit of its objective.
const kEnds = [
  added(
    "start_value",
    "objective at start",
    "The campaign’s objective (search.maximise) of the draw, before its ascent.",
    { usual: true },
  ),
  added(
    "end_value",
    "objective",
    "The campaign’s objective (search.maximise) of this sheet: N mm/mm for friction, mm for a margin against miscuts.",
    { usual: true },
  ),
];
const kEnergy = [
  added(
    "energy_n_mm",
    "energy",
    "Strain energy at D of springs with the report’s stiffness k on all diagonals, relaxed when flat: k/2 times stretch². Not a column of the catalogue.",
    { unit: "N mm", may_be_unknown: false },
  ),
];
// Columns that options such as `--deploy` add.
const kOfStudies = words.columns_of_studies
  .filter(({ name }) => name !== "energy_n_mm") // the page computes it
  .map(({ name, label, meaning, ...rest }) => added(name, label, meaning, rest));
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
