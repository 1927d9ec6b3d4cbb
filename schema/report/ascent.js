// Says by how many steps an ascent improved a draw, and which constraints limit its optimum.
import { h, number, plural } from "./format.js";

const kMostNamed = 4;

/** Active constraints, with the gain of the objective where each is relaxed. */
function limit_words(limits) {
  const more = (value, what) => (value > 0 ? [`${what}: +${number(value)}`] : []);
  const turning = limits.turning
    .slice(0, kMostNamed)
    .map(({ diagonal, pilot_deg }) => `${diagonal} near ${number(pilot_deg)}°`);
  const rest = limits.turning.length - turning.length;
  return [
    ...more(limits.per_mm_of_amplitude / 10, "0.1 mm more amplitude"),
    ...more(limits.per_share_of_stroke / 100, "1 % more stroke"),
    ...more(limits.per_n_of_force, "1 N more spring force"),
    ...Object.entries(limits.per_1_of_floors).flatMap(([name, value]) =>
      value > 0 ? [`lower bound of ${name}`] : [],
    ),
    ...(turning.length
      ? [`reversal of ${turning.join(", ")}${rest > 0 ? ` and ${rest} more` : ""}`]
      : []),
    ...(limits.fold_limit ? ["fold limit"] : []),
  ];
}

const kEnds = {
  no_step_is_better: "until no step improved it",
  most_steps: "the campaign’s largest number",
  breaks_a_limit:
    "The draw is infeasible: it violates a constraint of the campaign. It is kept unchanged.",
  has_no_value: "The objective is undefined for this draw. It is kept unchanged.",
};

/** Shows nothing of a draw that no ascent improved. */
export function show_ascent(box, detail) {
  const ascent = detail?.ascent;
  if (!ascent) return box.replaceChildren();
  if (ascent.start_value === null)
    return box.replaceChildren(h("p", { class: "note" }, kEnds[ascent.ended]));
  const limits = ascent.limited_by ? limit_words(ascent.limited_by) : [];
  box.replaceChildren(
    h(
      "p",
      {},
      `Optimised from ${ascent.start ? "its draw" : "a sheet of a population"} in ${plural(ascent.steps, "step")}, ${kEnds[ascent.ended]}. Objective: ${number(ascent.start_value)} at the start, ${number(ascent.end_value)} at the optimum.`,
    ),
    ...(limits.length
      ? [
          h(
            "p",
            { class: "note" },
            `Active constraints, with the objective’s gain to first order where they are relaxed: ${limits.join("; ")}.`,
          ),
        ]
      : []),
  );
}
