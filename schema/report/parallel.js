// Parallel coordinates: an axis for each metric, a line for each candidate. Brushing an axis sets a
// condition of the filter.
import * as Plot from "@observablehq/plot";
import { when_wide } from "./chart.js";
import { as_sql, bounds_in, with_bounds } from "./conditions.js";
import { by_id, h, plural } from "./format.js";
import { metrics, with_unit } from "./metrics.js";
import { colour, on_theme } from "./theme.js";

const kHeight = 300,
  kTop = 46, // for the axis' name and its upper end
  kBottom = 24,
  kSide = 46,
  kReach_px = 16,
  kLeast_px = 4, // of a brush; a shorter one removes the condition
  kMost = 9, // axes
  kMany = 2000;

// The axes where no columns are chosen.
const kUsual = [
  "deploys_from_deg",
  "certified_deg",
  "start_value",
  "end_value",
  "critical_friction_n_mm_per_mm",
  "static_friction_n_mm_per_mm",
  "energy_friction_n_mm_per_mm",
  "miscut_margin_mm",
  "yield",
  "slope_min_mm_per_deg",
  "stroke_min",
  "stroke_max",
  "stretch_sq_mm2",
  "shifted_vertices",
];

/** The chosen columns, or the usual ones, in which candidates differ. */
export function axes_of(candidates, chosen) {
  const wanted = chosen ? chosen.split(",") : kUsual;
  return metrics
    .filter(({ name }) => wanted.includes(name) && candidates.columns[name])
    .filter(
      ({ name }) => new Set(candidates.columns[name].filter((value) => value !== null)).size > 1,
    )
    .sort((a, b) => wanted.indexOf(a.name) - wanted.indexOf(b.name))
    .slice(0, kMost);
}

/** Maps values to pixels; on a logarithmic scale over more than three decades. */
function scale_of(values) {
  const known = values.filter((value) => value !== null);
  const [least, most] = known.reduce(
    ([a, b], v) => [Math.min(a, v), Math.max(b, v)],
    [Infinity, -Infinity],
  );
  const type = least > 0 && most / least > 1000 ? "log" : "linear";
  const scale = Plot.scale({
    y: { type, domain: [least, most], range: [kHeight - kBottom, kTop] },
  });
  return { least, most, apply: scale.apply, invert: scale.invert };
}

class Parallel {
  #candidates;
  #state;
  #axes = [];
  #brush = null; // { axis, from, to } while a pointer is down
  #width = 0;
  #canvas = h("canvas", { "data-testid": "parallel-canvas", "aria-hidden": "true" });

  constructor(box, candidates, state) {
    [this.#candidates, this.#state] = [candidates, state];
    box.classList.add("parallel");
    box.append(this.#canvas);
    this.#listen();
    when_wide(box, (width) => {
      this.#width = width;
      this.#lay_out();
    });
  }

  #listen() {
    const canvas = this.#canvas;
    canvas.addEventListener("pointerdown", (event) => {
      const { x, y } = this.#place(event),
        axis = this.#axes.find((near) => Math.abs(near.x - x) <= kReach_px);
      if (!axis) return;
      canvas.setPointerCapture(event.pointerId);
      this.#brush = { axis, from: y, to: y };
    });
    canvas.addEventListener("pointermove", (event) => {
      const { x, y } = this.#place(event);
      canvas.style.cursor = this.#axes.some((axis) => Math.abs(axis.x - x) <= kReach_px)
        ? "ns-resize"
        : "default";
      if (!this.#brush) return;
      this.#brush.to = y;
      this.#paint();
    });
    canvas.addEventListener("pointerup", () => this.#end_brush());
    canvas.addEventListener("pointercancel", () => {
      this.#brush = null;
      this.#paint();
    });
    for (const what of ["order", "picked", "filter"]) this.#state.on(what, () => this.#paint());
    this.#state.on("columns", () => this.#lay_out());
    on_theme(() => this.#paint());
  }

  #place(event) {
    const frame = this.#canvas.getBoundingClientRect();
    return {
      x: ((event.clientX - frame.left) * this.#width) / frame.width,
      y: ((event.clientY - frame.top) * kHeight) / frame.height,
    };
  }

  #end_brush() {
    if (!this.#brush) return;
    const { axis, from, to } = this.#brush;
    this.#brush = null;
    const [high, low] = [Math.min(from, to), Math.max(from, to)].map((y) =>
      Math.min(Math.max(y, kTop), kHeight - kBottom),
    );
    // An end of the axis is no bound.
    const bound = (y, end) =>
      Math.abs(y - end) < 1 ? null : Number(axis.invert(y).toPrecision(3));
    const bounds =
      low - high < kLeast_px
        ? { least: null, most: null }
        : { least: bound(low, kHeight - kBottom), most: bound(high, kTop) };
    this.#state.set("filter", with_bounds(this.#state.get("filter"), axis.metric.name, bounds));
    this.#paint();
  }

  #lay_out() {
    if (!this.#width) return;
    const shown = axes_of(this.#candidates, this.#state.get("columns")),
      step = shown.length > 1 ? (this.#width - 2 * kSide) / (shown.length - 1) : 0;
    this.#axes = shown.map((metric, k) => ({
      metric,
      x: kSide + k * step,
      room: Math.min(step || this.#width, 150) - 8,
      values: this.#candidates.columns[metric.name],
      ...scale_of(this.#candidates.columns[metric.name]),
    }));
    this.#canvas.dataset.axes = shown.map(({ name }) => name).join(" ");
    this.#paint();
  }

  #line(pen, row) {
    let open = false;
    pen.beginPath();
    for (const { x, values, apply } of this.#axes) {
      if (values[row] === null) {
        open = false; // no value
        continue;
      }
      if (open) pen.lineTo(x, apply(values[row]));
      else pen.moveTo(x, apply(values[row]));
      open = true;
    }
    pen.stroke();
  }

  #paint() {
    if (!this.#width) return;
    const ratio = devicePixelRatio || 1,
      canvas = this.#canvas,
      pen = canvas.getContext("2d"),
      { count: all, row_of } = this.#candidates,
      order = this.#state.get("order") ?? [];
    canvas.width = this.#width * ratio;
    canvas.height = kHeight * ratio;
    canvas.style.width = `${this.#width}px`;
    pen.scale(ratio, ratio);
    pen.lineWidth = 1;
    const shown = new Uint8Array(all);
    for (const row of order) shown[row] = 1;
    for (const [wanted, ink, opacity] of [
      [0, "ink-soft", 0.06],
      [1, "accent", all > kMany ? 0.12 : 0.35],
    ]) {
      pen.strokeStyle = colour(ink);
      pen.globalAlpha = opacity;
      for (let row = 0; row < all; ++row) if (shown[row] === wanted) this.#line(pen, row);
    }
    pen.globalAlpha = 1;
    for (const axis of this.#axes) this.#paint_axis(pen, axis);
    const picked = row_of.get(this.#state.get("picked"));
    if (picked !== undefined) {
      [pen.strokeStyle, pen.lineWidth] = [colour("pick"), 2.5];
      this.#line(pen, picked);
    }
    this.#say(order);
  }

  #paint_axis(pen, { metric, x, room, least, most, apply }) {
    const bottom = kHeight - kBottom,
      filter = bounds_in(this.#state.get("filter"), metric.name),
      brush = this.#brush?.axis.metric === metric ? this.#brush : null;
    [pen.strokeStyle, pen.lineWidth] = [colour("ink-soft"), 1];
    pen.beginPath();
    pen.moveTo(x, kTop);
    pen.lineTo(x, bottom);
    pen.stroke();
    if (brush || filter.least !== null || filter.most !== null) {
      const within = (y) => Math.min(Math.max(y, kTop), bottom);
      const ends = brush
        ? [brush.from, brush.to]
        : [
            filter.most === null ? kTop : apply(filter.most),
            filter.least === null ? bottom : apply(filter.least),
          ];
      const [up, down] = [within(Math.min(...ends)), within(Math.max(...ends))];
      [pen.fillStyle, pen.globalAlpha] = [colour("pick"), 0.3];
      pen.fillRect(x - 6, up, 12, Math.max(down - up, 1));
      pen.globalAlpha = 1;
    }
    pen.fillStyle = colour("ink");
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    const value = (number) => with_unit(metric, number);
    pen.fillText(metric.label, x, 14, room);
    pen.fillStyle = colour("ink-soft");
    pen.fillText(value(most), x, kTop - 10, room);
    pen.fillText(value(least), x, kHeight - 6, room);
  }

  #say(order) {
    const sql = as_sql(this.#state.get("filter")),
      note = by_id("parallel-note");
    note.textContent = `${plural(order.length, "candidate")} shown, a line each. Axes: usual metrics, or the chosen columns. Drag along an axis to set a range; click it to remove the range. `;
    if (sql)
      note.append(
        "As an option of other verbs: ",
        h("code", { "data-testid": "parallel-where" }, `--where "${sql}"`),
      );
  }
}

/** Hides the card where candidates differ in fewer than two metrics. */
export function make_parallel(box, candidates, state) {
  box.closest(".card").hidden = axes_of(candidates, "").length < 2;
  if (!box.closest(".card").hidden) new Parallel(box, candidates, state);
}
