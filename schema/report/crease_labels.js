// Places the labels of a crease pattern at any zoom, without overlaps. Labels without room appear
// when zooming in.
import { clamp } from "./format.js";
import { text_width } from "./text_size.js";

const kGap_px = 2;

/** Height of the letters, px, by a panel's side. */
export const label_px = (panel_px) => clamp(0.135 * panel_px, 10.5, 14);
export const number_px = (panel_px) => clamp(0.15 * panel_px, 11, 17);

// Other directions of a label, from its best one.
const kTurns_deg = [0, 50, -50, 95, -95, 140, -140];

function turned([x, y], deg) {
  const [c, s] = [Math.cos((deg * Math.PI) / 180), Math.sin((deg * Math.PI) / 180)];
  return [c * x - s * y, s * x + c * y];
}

/** Offset in px of a label's middle from a place that its letters must not cover. */
const stand_off = ([x, y], [half_width, half_height]) => {
  const reach = Math.abs(x) * (half_width + 5) + Math.abs(y) * (half_height + 6);
  return [x * reach, y * reach];
};

/** Possible places of a label, each with its offset in px. */
function spots({ places, away }, half) {
  if (!away) return places.map((at) => ({ at, offset: [0, 0] }));
  return places.flatMap((at) =>
    kTurns_deg.map((deg) => ({ at, offset: stand_off(turned(away, deg), half) })),
  );
}

/**
 * Shows the labels that have room, in their order. A label: { node, places: [[x, y]…] in the
 * drawing's units, the best first, away: its best direction off the place, or null, size_px, bold
 * }.
 */
export function place_labels(labels, view, scale) {
  const taken = [];
  const meets = (a) => taken.some((b) => a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]);
  for (const label of labels) {
    const { node, size_px, bold } = label;
    const half = [text_width(node.textContent, size_px, bold ? 700 : 400) / 2, size_px / 2];
    const box_at = ({ at, offset }) => {
      const [x, y] = view.place(at).map((px, i) => px + offset[i]),
        [wide, high] = half.map((side) => side + kGap_px);
      return [x - wide, y - high, x + wide, y + high];
    };
    const spot = spots(label, half).find((place) => !meets(box_at(place)));
    node.style.display = spot ? "" : "none";
    if (!spot) continue;
    taken.push(box_at(spot));
    ["x", "y"].forEach((name, i) =>
      node.setAttribute(name, (spot.at[i] + spot.offset[i] / scale).toFixed(3)),
    );
    node.style.fontSize = `${(size_px / scale).toFixed(4)}px`;
  }
}
