// Draws the flat sheet as SVG, for the map of the faults and the crease pattern.
import { h } from "./format.js";

/** "[2, 3]": row and column. */
export const place_name = ([row, column]) => `[${row}, ${column}]`;
export const panel_name = (sheet, panel) => `panel ${place_name(sheet.panel_places[panel])}`;
/** The number of the panel at [row, column]. */
export const panel_at = (sheet, [row, column]) =>
  sheet.panel_places.findIndex((place) => place[0] === row && place[1] === column);

/** y points up on the sheet and down on the screen. */
const place = ([x, y]) => `${x.toFixed(2)},${(-y).toFixed(2)}`;

/** Length of a panel's shorter side, which sets the size of text and strokes. */
export function panel_size_mm({ vertices_mm, panels }) {
  const corners = panels[0].map((k) => vertices_mm[k]);
  const side = (i) => Math.hypot(...[0, 1].map((xy) => corners[i][xy] - corners[i + 1][xy]));
  return Math.min(side(0), side(1));
}

/** Height of a sheet's view by its card's width, px. */
export const view_height = (width) =>
  Math.round(Math.min(0.9 * width, Math.max(570, Math.min(0.7 * width, 720))));

/** Bounding box of the sheet with a margin, y downwards. */
export function sheet_extent(vertices_mm, margin_mm) {
  const xs = vertices_mm.map((v) => v[0]),
    ys = vertices_mm.map((v) => -v[1]);
  const [x, y] = [Math.min(...xs) - margin_mm, Math.min(...ys) - margin_mm];
  return { x, y, width: Math.max(...xs) - x + margin_mm, height: Math.max(...ys) - y + margin_mm };
}

/** An empty drawing of that extent. */
export function sheet_svg(vertices_mm, margin_mm, label) {
  const { x, y, width, height } = sheet_extent(vertices_mm, margin_mm);
  return h("svg:svg", {
    class: "sheet",
    role: "img",
    "aria-label": label,
    viewBox: [x, y, width, height].map((value) => value.toFixed(1)).join(" "),
  });
}

export function polygon(corners, vertices_mm, attributes) {
  return h("svg:polygon", {
    points: corners.map((k) => place(vertices_mm[k])).join(" "),
    ...attributes,
  });
}

export function line(a, b, attributes) {
  return h("svg:line", {
    x1: a[0].toFixed(3),
    y1: (-a[1]).toFixed(3),
    x2: b[0].toFixed(3),
    y2: (-b[1]).toFixed(3),
    ...attributes,
  });
}
