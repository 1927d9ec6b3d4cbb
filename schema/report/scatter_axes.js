// The axes of the scatter plot: their metrics, scales, and steps along them.
import { extent, power, powers } from "./format.js";
import { axis_title, metrics } from "./metrics.js";

/** An axis of a domain, or of all values; logarithmic for positive ones over three decades. */
export function scale_of(metric, values, domain) {
  let [least, most] = extent(values);
  if (least > most) [least, most] = [0, 1];
  const log = least > 0 && most / least > 1000;
  const spare = log ? 0 : (most - least) * 0.03 || Math.abs(most) * 0.05 || 0.5;
  const whole = log ? [least / 1.2, most * 1.2] : [least - spare, most + spare];
  const shown = domain ?? whole,
    ticks = log ? powers(...shown) : [];
  return {
    type: log ? "log" : "linear",
    domain: shown,
    whole,
    ...(ticks.length > 1 ? { ticks, tickFormat: power } : {}),
    label: axis_title(metric) + (log ? ", log scale" : ""),
    labelAnchor: "center",
    grid: true,
  };
}

/** The metrics of the candidates, and the first two axes. */
export const metrics_of = (candidates) => metrics.filter(({ name }) => candidates.columns[name]);
export function first_axes(candidates) {
  const present = metrics_of(candidates)
    .map(({ name }) => name)
    .filter((name) => candidates.columns[name].some((value) => value !== null));
  const first = (i, ...wanted) =>
    wanted.find((name) => present.includes(name)) ?? present[i] ?? null;
  // Sheets that are driven by their energy alone have no least slope.
  return {
    across: first(0, "stroke_max"),
    up: first(1, "slope_min_mm_per_deg", "energy_friction_n_mm_per_mm"),
  };
}

/**
 * The next row in an arrow's direction that may be taken, -1 without any, null for other keys;
 * equals are ordered by the other axis, then by their rows.
 */
export function next_row(xs, ys, key, { from, may_be }) {
  const way = {
    ArrowRight: [xs, ys, 1],
    ArrowLeft: [xs, ys, -1],
    ArrowUp: [ys, xs, -1],
    ArrowDown: [ys, xs, 1],
  }[key];
  if (!way) return null;
  const [along, other, sign] = way;
  const before = (a, b) => sign * (along[a] - along[b]) || other[a] - other[b] || a - b;
  let best = -1;
  for (let row = 0; row < xs.length; ++row) {
    const further = from === undefined || before(row, from) > 0;
    if (!further || !may_be(row)) continue;
    if (best < 0 || before(row, best) < 0) best = row;
  }
  return best;
}
