// Sliders for the angle of use and the hinges' friction, each of which writes a condition into the
// filter.
import { bounds_in, with_bounds } from "./conditions.js";
import { by_id, h, number } from "./format.js";
import { metric_of, with_unit } from "./metrics.js";

const kLimits = [
  { name: "deploys_from_deg", says: "Angle of use" },
  { name: "critical_friction_n_mm_per_mm", says: "Hinge friction" },
];
const kSteps = 200;

function slider({ name, says }, values, state) {
  const known = values.filter((value) => value !== null);
  const [least, most] = [Math.min(...known), Math.max(...known)],
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
    const value = bounds_in(filter, name).least;
    input.value = value === null ? 0 : Math.round((value - least) / step);
    out.textContent =
      value === null ? "any" : with_unit({ ...metric_of[name], text: (v) => number(v) }, value);
  };
  state.on("filter", show);
  show(state.get("filter"));
  return h("label", { title: metric_of[name].about }, `${says} `, input, " ", out);
}

/** Adds sliders for columns in which candidates differ. */
export function make_limits(candidates, state) {
  for (const limit of kLimits) {
    const values = candidates.columns[limit.name],
      known = values?.filter((value) => value !== null) ?? [];
    if (new Set(known).size > 1) by_id("limits").append(slider(limit, values, state));
  }
}
