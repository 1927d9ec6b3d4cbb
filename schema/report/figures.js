// The figures of the overview: a tile for each, and those that every campaign may have.
import { by_id, count, degrees, h, number, plural } from "./format.js";
import { noun } from "./page_kind.js";

export function tile(term, value, more, title) {
  return h(
    "div",
    { title },
    h("dt", {}, term),
    h("dd", {}, h("strong", {}, value), more ? h("span", { class: "note" }, more) : null),
  );
}

/** Whether work remains: of so many that are wanted so many are missing; null: without end. */
export const how_far = (complete, done, missing) =>
  complete
    ? "complete"
    : missing === null
      ? "the campaign may go on"
      : `of ${count(done + missing)}, the last run's goal`;

/** Of what the catalogue has beyond the goal, and what counts it; none if that is nothing. */
export const beyond_tiles = (some, words) =>
  some > 0 ? [tile("Beyond the goal", count(some), words)] : [];

export const shown_tiles = ({ shown, total }) =>
  shown < total
    ? [tile("In this report", count(shown), `best of ${plural(total, "candidate")}`)]
    : [];

/** What is known only while a server is asked: see watch.js. */
export function live_tiles(report) {
  const { live, state } = report;
  if (!live) return [];
  const [draw] = live.best.draw ?? [],
    [from_deg] = live.best.deploys_from_deg ?? [],
    margin_mm = live.best.miscut_margin_mm?.[0];
  const margin = margin_mm > 0 ? `, margin ${number(margin_mm)} mm` : "";
  return [
    ...(state.ladder
      ? []
      : [tile("Draws a second", count(Math.round(live.draws_per_s)), live.speed_words)]),
    tile(
      "Best so far",
      draw === undefined ? "–" : degrees(from_deg),
      draw === undefined ? "no candidate yet" : `${noun(report)} ${draw}${margin}`,
      "The largest pilot angle that a candidate deploys from; the more tolerant first among equals",
    ),
  ];
}

/** Those that have changed are put in the place of what they were: what is marked stays so. */
export function show_tiles(tiles) {
  const box = by_id("figures");
  tiles.forEach((node, k) => {
    const before = box.children[k];
    if (!before) box.append(node);
    else if (!before.isEqualNode(node)) before.replaceWith(node);
  });
  while (box.children.length > tiles.length) box.lastChild.remove();
}
