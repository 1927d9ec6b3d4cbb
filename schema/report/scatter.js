// Scatter plot of two metrics of the candidates: axes by Plot, marks on a canvas, which is fast for
// tens of thousands. A drag enlarges a region.
import * as Plot from "@observablehq/plot";
import { plot_with_room, when_wide } from "./chart.js";
import { with_bounds } from "./conditions.js";
import { follow_drags } from "./dragged_region.js";
import { by_id, clamp, h, with_modifier } from "./format.js";
import { front_of } from "./front.js";
import { axis_title, metric_of, with_unit } from "./metrics.js";
import { add_saving } from "./save.js";
import { metrics_of, next_row, scale_of } from "./scatter_axes.js";
import {
  drawn_mark,
  legend_of,
  marks_of,
  paint_marks,
  quiet_marks,
  scatter_words,
} from "./scatter_marks.js";
import { colour, on_theme } from "./theme.js";

const kHeight = 400,
  kMargins = { marginLeft: 66, marginRight: 16, marginTop: 14, marginBottom: 44 },
  kReach_px = 24,
  kStep = 2; // of a key's zoom

class Scatter {
  #candidates;
  #state;
  #axes = h("div");
  #tip = h("output", { class: "tip", hidden: true, "aria-hidden": "true" });
  #ring = h("div", { class: "ring", hidden: true });
  #canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "data-testid": "scatter-canvas",
    "aria-label":
      "Scatter of two metrics. Arrow keys pick the next candidate along an axis, a click the nearest. A drag enlarges a region, + and − the region around the picked candidate; 0 shows the whole plot.",
  });
  #width = 0;
  #frame = { left: 0, right: 0, top: 0, bottom: 0 };
  #scales = []; // of both axes
  #region = [null, null]; // the enlarged domains
  #xs = new Float64Array(0);
  #ys = new Float64Array(0);
  #shown = new Uint8Array(0);
  #was_dragged;

  constructor(box, candidates, state, name) {
    [this.#candidates, this.#state] = [candidates, state];
    for (const axis of ["across", "up"]) this.#add_select(axis);
    box.append(this.#axes, this.#canvas, this.#ring, this.#tip);
    box.classList.add("scatter");
    this.#was_dragged = follow_drags(this.#canvas, (dragged) => this.#enlarge(dragged));
    this.#listen();
    when_wide(box, (width) => {
      this.#width = width;
      this.#draw();
    });
    add_saving(box.closest(".card"), {
      name: `${name}-scatter`,
      csv: () => this.#rows(),
      svg: () => this.#drawing(),
    });
  }

  #add_select(axis) {
    const select = by_id(`scatter-${axis === "across" ? "x" : "y"}`);
    select.append(
      ...metrics_of(this.#candidates).map((metric) =>
        h("option", { value: metric.name }, axis_title(metric)),
      ),
    );
    select.value = this.#state.get(axis);
    select.addEventListener("change", () => this.#state.set(axis, select.value));
    this.#state.on(axis, (name) => {
      select.value = name;
      this.#show_region([null, null]);
    });
  }

  #listen() {
    const canvas = this.#canvas,
      state = this.#state,
      pick = (row) => row >= 0 && state.set("picked", this.#candidates.columns.draw[row]);
    canvas.addEventListener("click", (event) => {
      if (!this.#was_dragged()) pick(this.#nearest(event).row);
    });
    canvas.addEventListener("pointermove", (event) => this.#tell(event));
    canvas.addEventListener("pointerleave", () => {
      this.#tip.hidden = true;
      state.set("hovered", null);
    });
    canvas.addEventListener("keydown", (event) => {
      if (this.#zoom(event)) return event.preventDefault();
      const row = with_modifier(event) ? null : this.#next(event.key);
      if (row === null) return;
      event.preventDefault();
      pick(row);
    });
    by_id("scatter-front").addEventListener("change", () => this.#paint());
    by_id("scatter-whole").addEventListener("click", () => this.#show_region([null, null]));
    by_id("scatter-keep").addEventListener("click", () => this.#filter_by_region());
    state.on("order", () => this.#paint());
    state.on("picked", () => this.#paint());
    state.on("hovered", () => this.#show_hovered());
    on_theme(() => this.#paint());
  }

  #metrics() {
    return ["across", "up"].map((axis) => metric_of[this.#state.get(axis)]);
  }

  #draw() {
    if (!this.#width) return;
    const shown = this.#metrics();
    const values = shown.map(({ name, axis = 1 }) =>
      this.#candidates.columns[name].map((value) => (value === null ? null : value * axis)),
    );
    const [across, up] = shown.map((metric, i) => scale_of(metric, values[i], this.#region[i]));
    const plot = plot_with_room({
      width: this.#width,
      height: kHeight,
      ...kMargins,
      ariaHidden: "true",
      x: across,
      y: up,
      marks: [Plot.frame({ stroke: "var(--line)" })],
    });
    this.#axes.replaceChildren(plot);
    const [x, y] = [plot.scale("x"), plot.scale("y")];
    [x.whole, y.whole] = [across.whole, up.whole];
    this.#scales = [x, y];
    const [[left, right], [bottom, top]] = [x.range, y.range];
    this.#frame = { left, right, top, bottom };
    this.#xs = Float64Array.from(values[0], (value) => (value === null ? NaN : x.apply(value)));
    this.#ys = Float64Array.from(values[1], (value) => (value === null ? NaN : y.apply(value)));
    this.#paint();
  }

  #show_region(region) {
    this.#region = region;
    const is_whole = region.every((domain) => domain === null);
    for (const id of ["scatter-whole", "scatter-keep"]) by_id(id).hidden = is_whole;
    this.#draw();
  }

  /** Shows a part of the canvas, in px, as large as the plot. */
  #enlarge({ left, right, top, bottom }) {
    const parts = [
      [left, right],
      [bottom, top],
    ];
    const region = this.#scales.map(({ invert, whole }, i) => {
      const [least, most] = parts[i].map((place) => clamp(invert(place), ...whole));
      return least < most ? [least, most] : null;
    });
    const is_whole = this.#scales.every(
      ({ whole }, i) =>
        region[i] === null || (region[i][0] === whole[0] && region[i][1] === whole[1]),
    );
    this.#show_region(is_whole ? [null, null] : region);
  }

  /** Zooms about the picked candidate or the middle by a key; returns whether it is one. */
  #zoom({ key, altKey, ctrlKey, metaKey }) {
    const factor = { "+": kStep, "=": kStep, "-": 1 / kStep, 0: 0 }[key];
    if (factor === undefined || altKey || ctrlKey || metaKey) return false;
    if (factor === 0) this.#show_region([null, null]);
    else {
      const { left, right, top, bottom } = this.#frame,
        picked = this.#candidates.row_of.get(this.#state.get("picked")),
        [x, y] = this.#is_visible(picked)
          ? [this.#xs[picked], this.#ys[picked]]
          : [(left + right) / 2, (top + bottom) / 2],
        at = (middle, end) => middle + (end - middle) / factor; // what is there stays there
      this.#enlarge({
        left: at(x, left),
        right: at(x, right),
        top: at(y, top),
        bottom: at(y, bottom),
      });
    }
    return true;
  }

  #filter_by_region() {
    let filter = this.#state.get("filter");
    for (const [i, { name, axis = 1 }] of this.#metrics().entries()) {
      const bounds = this.#region[i]?.map((end) => Number((end / axis).toPrecision(4)));
      if (bounds) filter = with_bounds(filter, name, { least: bounds[0], most: bounds[1] });
    }
    this.#state.set("filter", filter);
  }

  #has_place(row) {
    return row !== undefined && !Number.isNaN(this.#xs[row] + this.#ys[row]);
  }

  #is_visible(row) {
    const { left, right, top, bottom } = this.#frame,
      [x, y] = [this.#xs[row], this.#ys[row]]; // NaN lies nowhere
    return x >= left && x <= right && y >= top && y <= bottom;
  }

  /** { marks, most, visible }: all marks in their order, as scatter_marks describes them. */
  #marks() {
    const { count: all, detailed, row_of } = this.#candidates,
      [visible, others] = [[], []];
    for (let row = 0; row < all; ++row)
      if (this.#is_visible(row)) (this.#shown[row] ? visible : others).push(row);
    const { marks, most } = marks_of(this.#xs, this.#ys, visible);
    const at = (row, rest) => ({ x: this.#xs[row], y: this.#ys[row], ...rest });
    const rings = [...detailed]
      .map((draw) => row_of.get(draw))
      .filter((row) => this.#shown[row] && this.#is_visible(row))
      .map((row) => at(row, { r: 4.5, stroke: colour("ink"), wide: 1.5 }));
    const picked = row_of.get(this.#state.get("picked"));
    const chosen = this.#is_visible(picked)
      ? [
          at(picked, { r: 5, fill: colour("pick") }),
          at(picked, { r: 9, stroke: colour("ink"), wide: 2 }),
        ]
      : [];
    const quiet = quiet_marks(this.#xs, this.#ys, others);
    return { marks: [...quiet, ...marks, ...rings, ...chosen], most, visible };
  }

  #paint() {
    if (!this.#width) return;
    const ratio = devicePixelRatio || 1,
      order = this.#state.get("order") ?? [],
      { left, right, top, bottom } = this.#frame;
    this.#canvas.width = this.#width * ratio;
    this.#canvas.height = kHeight * ratio;
    this.#canvas.style.width = `${this.#width}px`;
    const pen = this.#canvas.getContext("2d");
    pen.scale(ratio, ratio);
    pen.beginPath();
    pen.rect(left - 1, top - 1, right - left + 2, bottom - top + 2);
    pen.clip();
    this.#shown = new Uint8Array(this.#candidates.count);
    for (const row of order) this.#shown[row] = 1;
    const { marks, most, visible } = this.#marks();
    paint_marks(pen, marks);
    this.#canvas.dataset.drawn = most === null ? "points" : "hexagons";
    const front = this.#front(order);
    this.#paint_front(pen, front);
    by_id("scatter-legend").replaceChildren(...legend_of(most));
    this.#show_hovered();
    this.#say(order, visible, front, most);
  }

  /** The Pareto front of the shown candidates, sorted by the first metric. */
  #front(order) {
    if (!by_id("scatter-front").checked) return [];
    const placed = order.filter((row) => this.#has_place(row)),
      goals = this.#metrics().map(({ name, better }) => ({
        values: this.#candidates.columns[name],
        better,
      }));
    return front_of(placed, goals).sort((a, b) => this.#xs[a] - this.#xs[b]);
  }

  #paint_front(pen, front) {
    [pen.strokeStyle, pen.lineWidth] = [colour("ink"), 1.5];
    pen.beginPath();
    for (const row of front) pen.lineTo(this.#xs[row], this.#ys[row]);
    pen.stroke();
  }

  #show_hovered() {
    const row = this.#candidates.row_of.get(this.#state.get("hovered"));
    this.#ring.hidden = !this.#is_visible(row);
    if (this.#ring.hidden) return;
    this.#ring.style.left = `${this.#xs[row]}px`;
    this.#ring.style.top = `${this.#ys[row]}px`;
  }

  #say(order, visible, front, most) {
    const missing = order.filter((row) => !this.#has_place(row)).length,
      outside = order.length - missing - visible.length;
    by_id("scatter-note").textContent = scatter_words({
      ...{ outside, missing, most, front: front.length, shown: visible.length },
      is_filtered: order.length < this.#candidates.count,
    });
  }

  #nearest(event) {
    const frame = this.#canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) * this.#width) / frame.width,
      y = ((event.clientY - frame.top) * kHeight) / frame.height;
    let best = -1,
      least = Infinity;
    for (let row = 0; row < this.#xs.length; ++row) {
      const away = (this.#xs[row] - x) ** 2 + (this.#ys[row] - y) ** 2;
      if (this.#shown[row] && away < least && this.#is_visible(row)) [best, least] = [row, away];
    }
    return { row: best, away: Math.sqrt(least) };
  }

  #tell(event) {
    const { row, away } = this.#nearest(event),
      tip = this.#tip,
      { draw } = this.#candidates.columns;
    tip.hidden = event.buttons !== 0 || row < 0 || away > kReach_px;
    this.#state.set("hovered", tip.hidden ? null : draw[row]);
    if (tip.hidden) return;
    const line = (metric) =>
      `${metric.label} ${with_unit(metric, this.#candidates.columns[metric.name][row])}`;
    tip.textContent = [`draw ${draw[row]}`, ...this.#metrics().map(line)].join("\n");
    tip.style.left = `${Math.min(this.#xs[row] + 12, this.#width - 190)}px`;
    tip.style.top = `${Math.max(0, this.#ys[row] - 62)}px`;
  }

  #next(key) {
    const picked = this.#candidates.row_of.get(this.#state.get("picked"));
    return next_row(this.#xs, this.#ys, key, {
      from: picked,
      may_be: (row) => this.#shown[row] && this.#is_visible(row),
    });
  }

  #rows() {
    const { columns } = this.#candidates,
      names = this.#metrics().map(({ name }) => name);
    return {
      heads: ["draw", ...names],
      rows: this.#state
        .get("order")
        .map((row) => [columns.draw[row], ...names.map((name) => columns[name][row])]),
    };
  }

  /** The axes, with the marks until they are copied. */
  #drawing() {
    const plot = this.#axes.firstChild,
      drawn = h("svg:g", { "data-styled": "" }, this.#marks().marks.map(drawn_mark));
    plot.append(drawn);
    queueMicrotask(() => drawn.remove());
    return plot;
  }
}

export const make_scatter = (box, candidates, state, name) =>
  new Scatter(box, candidates, state, name);
