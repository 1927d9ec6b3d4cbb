// Parallel coordinates: an axis for each metric, a line for each candidate; the density of lines
// where there are many. Brushing an axis sets a condition of the filter.
import * as Plot from "@observablehq/plot";
import { when_wide } from "./chart.js";
import { as_sql, bounds_in, with_bounds } from "./conditions.js";
import { by_id, clamp, differ, extent, h, plural } from "./format.js";
import { metrics, with_unit } from "./metrics.js";
import { kMostLines, paint_rows } from "./parallel_rows.js";
import { colour, on_theme } from "./theme.js";

const kHeight = 300,
  kTop = 46, // for the axis' name and its upper end
  kBottom = 24,
  kSide = 46,
  kReach_px = 16, // of an axis
  kNear_px = 10, // of a line
  kLeast_px = 4, // of a brush; a shorter one removes the condition
  kMostAxes = 12,
  kAxis_px = 80; // least distance of axes

/** The chosen columns, or the usual ones, in which candidates differ. */
function axes_of(candidates, chosen, most = kMostAxes) {
  const wanted = chosen
    ? chosen.split(",")
    : metrics.filter(({ usual }) => usual).map(({ name }) => name);
  return metrics
    .filter(({ name }) => wanted.includes(name) && differ(candidates.columns[name] ?? []))
    .sort((a, b) => wanted.indexOf(a.name) - wanted.indexOf(b.name))
    .slice(0, most);
}

/** Maps values to pixels; on a logarithmic scale over more than three decades. */
function scale_of(values) {
  const [least, most] = extent(values);
  const type = least > 0 && most / least > 1000 ? "log" : "linear";
  const { apply, invert } = Plot.scale({
    y: { type, domain: [least, most], range: [kHeight - kBottom, kTop] },
  });
  const ys = Float32Array.from(values, (value) => (value === null ? NaN : apply(value)));
  return { least, most, apply, invert, ys };
}

class Parallel {
  #candidates;
  #state;
  #axes = [];
  #brush = null; // { axis, from, to } while a pointer is down
  #width = 0;
  #shown = [];
  #ground = document.createElement("canvas"); // all that does not follow the pointer
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
    const canvas = this.#canvas,
      state = this.#state;
    canvas.addEventListener("pointerdown", (event) => {
      const { x, y } = this.#place(event),
        axis = this.#axis_at(x);
      if (!axis) return;
      canvas.setPointerCapture(event.pointerId);
      this.#brush = { axis, from: y, to: y };
    });
    canvas.addEventListener("pointermove", (event) => {
      const { x, y } = this.#place(event);
      if (this.#brush) {
        this.#brush.to = y;
        return this.#paint();
      }
      const near = this.#axis_at(x) ? undefined : this.#nearest(x, y);
      canvas.style.cursor = this.#axis_at(x) ? "ns-resize" : near ? "pointer" : "default";
      state.set("hovered", near ?? null);
    });
    canvas.addEventListener("pointerleave", () => state.set("hovered", null));
    canvas.addEventListener("click", (event) => {
      const { x, y } = this.#place(event),
        near = this.#axis_at(x) ? undefined : this.#nearest(x, y);
      if (near) state.set("picked", near);
    });
    canvas.addEventListener("pointerup", () => this.#end_brush());
    canvas.addEventListener("pointercancel", () => {
      this.#brush = null;
      this.#paint();
    });
    for (const what of ["picked", "hovered", "filter"]) state.on(what, () => this.#paint());
    state.on("order", () => this.#paint_ground());
    state.on("columns", () => this.#lay_out());
    on_theme(() => this.#paint_ground());
  }

  #place(event) {
    const frame = this.#canvas.getBoundingClientRect();
    return {
      x: ((event.clientX - frame.left) * this.#width) / frame.width,
      y: ((event.clientY - frame.top) * kHeight) / frame.height,
    };
  }

  #axis_at(x) {
    return this.#axes.find((axis) => Math.abs(axis.x - x) <= kReach_px);
  }

  /** The draw of the shown line nearest to a place between two axes, if one is near. */
  #nearest(x, y) {
    const k = this.#axes.findIndex((axis) => axis.x > x),
      [from, to] = [this.#axes[k - 1], this.#axes[k]];
    if (!from || !to) return undefined;
    const share = (x - from.x) / (to.x - from.x);
    let best,
      least = kNear_px;
    for (const row of this.#shown) {
      const away = Math.abs(from.ys[row] + share * (to.ys[row] - from.ys[row]) - y);
      if (away < least) [best, least] = [row, away];
    }
    return this.#candidates.columns.draw[best];
  }

  #end_brush() {
    if (!this.#brush) return;
    const { axis, from, to } = this.#brush;
    this.#brush = null;
    const [high, low] = [Math.min(from, to), Math.max(from, to)].map((y) =>
      clamp(y, kTop, kHeight - kBottom),
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
    const most = clamp(Math.floor(this.#width / kAxis_px), 3, kMostAxes),
      shown = axes_of(this.#candidates, this.#state.get("columns"), most),
      step = shown.length > 1 ? (this.#width - 2 * kSide) / (shown.length - 1) : 0;
    this.#axes = shown.map((metric, k) => ({
      metric,
      x: kSide + k * step,
      room: Math.min(step || this.#width, 150) - 8,
      ...scale_of(this.#candidates.columns[metric.name]),
    }));
    this.#canvas.dataset.axes = shown.map(({ name }) => name).join(" ");
    this.#paint_ground();
  }

  #paint_ground() {
    if (!this.#width) return;
    const ratio = devicePixelRatio || 1,
      pen = this.#ground.getContext("2d");
    this.#shown = this.#state.get("order") ?? [];
    for (const canvas of [this.#ground, this.#canvas]) {
      canvas.width = this.#width * ratio;
      canvas.height = kHeight * ratio;
    }
    this.#canvas.style.width = `${this.#width}px`;
    pen.scale(ratio, ratio);
    const all = new Uint8Array(this.#candidates.count);
    for (const row of this.#shown) all[row] = 1;
    const others = [...all.keys()].filter((row) => !all[row]);
    paint_rows(pen, this.#axes, others, { height: kHeight, quiet: true });
    paint_rows(pen, this.#axes, this.#shown, { height: kHeight, quiet: false });
    for (const axis of this.#axes) this.#paint_axis(pen, axis);
    this.#canvas.dataset.drawn = this.#shown.length > kMostLines ? "density" : "lines";
    this.#say();
    this.#paint();
  }

  /** The ground, the brushes, and the lines of the hovered and the picked candidate. */
  #paint() {
    if (!this.#width || !this.#ground.width) return;
    const pen = this.#canvas.getContext("2d"),
      ratio = devicePixelRatio || 1;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, this.#canvas.width, this.#canvas.height);
    pen.drawImage(this.#ground, 0, 0);
    pen.scale(ratio, ratio);
    for (const axis of this.#axes) this.#paint_brush(pen, axis);
    for (const [name, ink, wide] of [
      ["hovered", "ink", 2],
      ["picked", "pick", 2.5],
    ]) {
      const row = this.#candidates.row_of.get(this.#state.get(name));
      if (row === undefined) continue;
      paint_rows(pen, this.#axes, [row], { ink: "card", wide: wide + 2.5 }); // stands off the others
      paint_rows(pen, this.#axes, [row], { ink, wide });
    }
  }

  #paint_brush(pen, { metric, x, apply }) {
    const bottom = kHeight - kBottom,
      filter = bounds_in(this.#state.get("filter"), metric.name),
      brush = this.#brush?.axis.metric === metric ? this.#brush : null;
    if (!brush && filter.least === null && filter.most === null) return;
    const ends = brush
      ? [brush.from, brush.to]
      : [
          filter.most === null ? kTop : apply(filter.most),
          filter.least === null ? bottom : apply(filter.least),
        ];
    const [up, down] = [Math.min(...ends), Math.max(...ends)].map((y) => clamp(y, kTop, bottom));
    [pen.fillStyle, pen.globalAlpha] = [colour("pick"), 0.35];
    pen.fillRect(x - 8, up, 16, Math.max(down - up, 1));
    pen.globalAlpha = 1;
  }

  #paint_axis(pen, { metric, x, room, least, most }) {
    [pen.strokeStyle, pen.lineWidth] = [colour("ink-soft"), 1];
    pen.beginPath();
    pen.moveTo(x, kTop);
    pen.lineTo(x, kHeight - kBottom);
    pen.stroke();
    pen.fillStyle = colour("ink");
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    const value = (number) => with_unit(metric, number);
    pen.fillText(metric.label, x, 14, room);
    pen.fillStyle = colour("ink-soft");
    pen.fillText(value(most), x, kTop - 10, room);
    pen.fillText(value(least), x, kHeight - 6, room);
  }

  #say() {
    const sql = as_sql(this.#state.get("filter")),
      note = by_id("parallel-note");
    const drawn =
      this.#shown.length > kMostLines
        ? "as the density of their lines; bars: quartiles and median"
        : "a line each";
    note.textContent = `${plural(this.#shown.length, "candidate")} shown, ${drawn}. Axes: usual metrics, or the chosen columns. Drag along an axis to set a range; click it to remove the range. Click a line to pick its candidate. `;
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
