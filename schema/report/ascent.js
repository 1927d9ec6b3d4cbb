// How an optimising search made a sheet of its draw, and what keeps it from more.
import { h, number, plural } from "./format.js";

const kMostNamed = 4;

/** By how much the goal would grow, most first. */
function limit_words(limits) {
  const more = (value, what) => (value > 0 ? [`${what} would give ${number(value)} more`] : []);
  const turning = limits.turning
    .slice(0, kMostNamed)
    .map(({ diagonal, pilot_deg }) => `${diagonal} near ${number(pilot_deg)}°`);
  const rest = limits.turning.length - turning.length;
  return [
    ...more(limits.per_mm_of_amplitude / 10, "an amplitude 0.1 mm larger"),
    ...more(limits.per_share_of_stroke / 100, "a stroke of 1 % more"),
    ...more(limits.per_n_of_force, "springs that bear 1 N more"),
    ...Object.entries(limits.per_1_of_floors).flatMap(([name, value]) =>
      value > 0 ? [`${name} may not be less`] : [],
    ),
    ...(turning.length
      ? [`turning back: ${turning.join(", ")}${rest > 0 ? ` and ${rest} more` : ""}`]
      : []),
    ...(limits.fold_limit ? ["how far it folds"] : []),
  ];
}

const kEnds = {
  no_step_is_better: "until no step was better",
  most_steps: "and no further, as the campaign asks",
  breaks_a_limit: "It breaks a limit of the campaign as it was drawn, and is kept so.",
  has_no_value: "It has no worth by the campaign’s goal, and is kept as it was drawn.",
};

/** Nothing where it was drawn as it is. */
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
      `Made of ${ascent.start ? "its draw" : "what a population met"} in ${plural(ascent.steps, "step")}, ${kEnds[ascent.ended]}: worth ${number(ascent.start_value)} as ${ascent.start ? "drawn" : "met"}, ${number(ascent.end_value)} now.`,
    ),
    ...(limits.length
      ? [h("p", { class: "note" }, `What limits it, to first order: ${limits.join("; ")}.`)]
      : []),
  );
}
