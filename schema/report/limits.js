// Sliders for the angle of use and the hinges' friction, each of which writes a condition into the
// filter. They begin at the values of the campaign's design.
import { bounds_in, with_bounds } from "./conditions.js";
import { by_id, differ, extent, h, number } from "./format.js";
import { metric_of, with_unit } from "./metrics.js";

const kLimits = [
  { name: "deploys_from_deg", says: "Angle of use", of_design: ({ from_deg }) => from_deg },
  {
    name: "critical_friction_n_mm_per_mm",
    says: "Hinge friction",
    of_design: ({ hinges }) => hinges?.friction_n_mm_per_mm || null, // 0: none
  },
];
const kSteps = 200;

/** The limits of which candidates differ, each with the design's value or null. */
const limits_of = (report, candidates) =>
  kLimits
    .filter(({ name }) => differ(candidates.columns[name] ?? []))
    .map((limit) => {
      const { design } = report.campaign.configuration;
      return { ...limit, designed: (design && limit.of_design(design)) ?? null };
    });

/** The conditions of the campaign's design, as text of the filter. */
export const filter_of_design = (report, candidates) =>
  limits_of(report, candidates)
    .filter(({ designed }) => designed !== null)
    .reduce((filter, { name, designed }) => with_bounds(filter, name, { least: designed }), "");

function slider({ name, says, designed }, values, state) {
  const [least, most] = extent(values),
    step = (most - least) / kSteps;
  const out = h("output", {});
  const input = h("input", {
    type: "range",
    min: 0,
    max: kSteps,
    step: 1,
    value: 0,
    "data-testid": `limit-${name}`,
    "aria-label": `${says}: ${metric_of[name].label} at least`,
  });
  const value_of = (place) => (place === 0 ? null : Number((least + place * step).toPrecision(3)));
  input.addEventListener("input", () => {
    state.set(
      "filter",
      with_bounds(state.get("filter"), name, { least: value_of(Number(input.value)) }),
    );
  });
  const show = (filter) => {
    const value = bounds_in(filter, name).least,
      origin = value !== null && value === designed ? ", of the design" : "";
    input.value = value === null ? 0 : Math.round((value - least) / step);
    out.textContent =
      value === null
        ? "any"
        : with_unit({ ...metric_of[name], text: (v) => number(v) }, value) + origin;
  };
  state.on("filter", show);
  show(state.get("filter"));
  return h("label", { title: metric_of[name].about }, `${says} `, input, " ", out);
}

/** Adds sliders for columns in which candidates differ. */
export function make_limits(report, candidates, state) {
  by_id("limits").append(
    ...limits_of(report, candidates).map((limit) =>
      slider(limit, candidates.columns[limit.name], state),
    ),
  );
}
