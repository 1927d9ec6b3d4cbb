// The marks of the scatter plot: points, or hexagons coloured by count where there are many.
import { count_scale, legend_counts } from "./count_scale.js";
import { count as count_words, h, legend_entry, plural } from "./format.js";
import { corners_of, hexagons_of } from "./hexagons.js";
import { colour } from "./theme.js";

/** Largest number of candidates that are painted as points. */
const kMostPoints = 2000;

const kRadius_px = 7; // of a hexagon

/** The marks of rows that stay behind the others. */
export function quiet_marks(xs, ys, rows) {
  if (rows.length <= kMostPoints) {
    const fill = colour("ink-soft");
    return rows.map((row) => ({ x: xs[row], y: ys[row], r: 2, fill, opacity: 0.2 }));
  }
  const fill = colour("nothing");
  return hexagons_of(xs, ys, rows, kRadius_px).map(({ x, y }) => ({
    ...{ x, y, fill, opacity: 1 },
    corners: corners_of(x, y, kRadius_px),
  }));
}

/** { marks, most }: the marks of rows, and the largest count of a hexagon; null of points. */
export function marks_of(xs, ys, rows) {
  if (rows.length <= kMostPoints) {
    const fill = colour("accent"),
      r = rows.length > 500 ? 2.2 : 2.8;
    const marks = rows.map((row) => ({ x: xs[row], y: ys[row], r, fill, opacity: 0.6 }));
    return { marks, most: null };
  }
  const hexagons = hexagons_of(xs, ys, rows, kRadius_px),
    most = Math.max(...hexagons.map(({ count }) => count)),
    fill_of = count_scale(most);
  const marks = hexagons.map(({ x, y, count }) => ({
    ...{ x, y, fill: fill_of(count), opacity: 1 },
    corners: corners_of(x, y, kRadius_px - 0.4),
  }));
  return { marks, most };
}

/** The legend of hexagons, with their largest count; nothing for points. */
export function legend_of(most) {
  if (most === null) return [];
  const fill_of = count_scale(most);
  return legend_counts(most).map((count) => legend_entry(fill_of(count), count_words(count)));
}

/** Describes the plot: numbers of candidates, and whether the filter leaves some out. */
export function scatter_words({ shown, outside, missing, most, front, is_filtered }) {
  return [
    plural(shown, "candidate") + " shown",
    outside ? `, ${count_words(outside)} outside this region` : "",
    missing ? `, ${count_words(missing)} without a value on these axes` : "",
    is_filtered ? "; faint: filtered out" : "",
    most === null ? "" : ". Hexagons are coloured by their number of candidates",
    ". Rings: all details in this report. Drag to enlarge a region.",
    front ? ` Line: Pareto front of ${plural(front, "candidate")}.` : "",
  ].join("");
}

/** Paints marks: { x, y, r } or { corners }, filled or with a stroke. */
export function paint_marks(pen, marks) {
  for (const { x, y, r, corners, fill, opacity, stroke, wide } of marks) {
    pen.globalAlpha = opacity ?? 1;
    pen.beginPath();
    if (corners) for (const corner of corners) pen.lineTo(...corner);
    else pen.arc(x, y, r, 0, 2 * Math.PI);
    if (fill) {
      pen.fillStyle = fill;
      pen.fill();
    } else {
      [pen.strokeStyle, pen.lineWidth] = [stroke, wide];
      pen.stroke();
    }
  }
  pen.globalAlpha = 1;
}

/** A mark of a drawing. */
export function drawn_mark({ x, y, r, corners, fill, opacity, stroke, wide }) {
  const style = {
    fill: fill ?? "none",
    "fill-opacity": opacity,
    stroke,
    "stroke-width": wide,
  };
  const written = (value) => value.toFixed(2);
  return corners
    ? h("svg:polygon", {
        points: corners.map((corner) => corner.map(written).join(",")).join(" "),
        ...style,
      })
    : h("svg:circle", { cx: written(x), cy: written(y), r, ...style });
}
