// Shows the overview's figures as tiles.
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

/** Progress in words; `missing` is null in a campaign without end. */
export const how_far = (complete, done, missing) =>
  complete
    ? "complete"
    : missing === null
      ? "campaign without end"
      : `of ${count(done + missing)}, the last run's goal`;

/** The tile of what lies beyond the goal, if anything does. */
export const beyond_tiles = (some, words) =>
  some > 0 ? [tile("Beyond the goal", count(some), words)] : [];

export const shown_tiles = ({ shown, total }) =>
  shown < total
    ? [tile("In this report", count(shown), `best of ${plural(total, "candidate")}`)]
    : [];

/** The figures of a page that watch.js keeps up to date. */
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
      : [tile("Draws per second", count(Math.round(live.draws_per_s)), live.speed_words)]),
    tile(
      "Best so far",
      draw === undefined ? "–" : degrees(from_deg),
      draw === undefined ? "no candidate yet" : `${noun(report)} ${draw}${margin}`,
      "Largest D of a candidate; among equals that with the larger margin",
    ),
  ];
}

/** Replaces only tiles that have changed, so that a reader's selection stays. */
export function show_tiles(tiles) {
  const box = by_id("figures");
  tiles.forEach((node, k) => {
    const before = box.children[k];
    if (!before) box.append(node);
    else if (!before.isEqualNode(node)) before.replaceWith(node);
  });
  while (box.children.length > tiles.length) box.lastChild.remove();
}
