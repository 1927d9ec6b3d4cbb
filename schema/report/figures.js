// The figures of the overview: a tile for each, and those that every campaign may have.
import { count, h, plural } from "./format.js";

export function tile(term, value, more, title) {
  return h(
    "div",
    { title },
    h("dt", {}, term),
    h("dd", {}, h("strong", {}, value), more ? h("span", { class: "note" }, more) : null),
  );
}

/** Whether work remains; `missing`: how much of it. */
export const how_far = (complete, missing) =>
  complete
    ? "complete"
    : missing
      ? `${count(missing)} of those asked for are missing`
      : "the campaign may go on";

/** Of what the catalogue has beyond the goal, and what counts it; none if that is nothing. */
export const beyond_tiles = (some, words) =>
  some > 0 ? [tile("Beyond the goal", count(some), words)] : [];

export const shown_tiles = ({ shown, total }) =>
  shown < total
    ? [tile("In this report", count(shown), `best of ${plural(total, "candidate")}`)]
    : [];
