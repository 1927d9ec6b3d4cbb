// Scatter plot of two metrics of the candidates: axes by Plot, points on a canvas, which is fast
// for tens of thousands.
import * as Plot from "@observablehq/plot";
import { plot_with_room, when_wide } from "./chart.js";
import { count, h, plural, power, powers, with_modifier } from "./format.js";
import { axis_title, metrics, metric_of, with_unit } from "./metrics.js";
import { add_saving } from "./save.js";
import { front_of } from "./front.js";
import { colour, on_theme } from "./theme.js";

const kHeight = 400,
  kMargins = { marginLeft: 66, marginRight: 16, marginTop: 14, marginBottom: 44 },
  kMany = 3000, // number of points from which they are drawn smaller
  kReach_px = 24;

/** An axis; logarithmic for positive values over more than three decades. */
function scale_of(metric, values) {
  let least = Infinity,
    most = -Infinity;
  for (const value of values) {
    if (value === null) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  if (least > most) [least, most] = [0, 1];
  const log = least > 0 && most / least > 1000;
  const spare = log ? 0 : (most - least) * 0.03 || Math.abs(most) * 0.05 || 0.5;
  return {
    type: log ? "log" : "linear",
    domain: log ? [least / 1.2, most * 1.2] : [least - spare, most + spare],
    ...(log ? { ticks: powers(least / 1.2, most * 1.2), tickFormat: power } : {}),
    label: axis_title(metric) + (log ? ", log scale" : ""),
    labelAnchor: "center",
    labelArrow: "none",
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

class Scatter {
  #candidates;
  #state;
  #axes = h("div");
  #tip = h("output", { class: "tip", hidden: true, "aria-hidden": "true" });
  #canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "data-testid": "scatter-canvas",
    "aria-label":
      "Scatter of two metrics. Arrow keys pick the next candidate along an axis, a click the nearest.",
  });
  #width = 0;
  #xs = new Float64Array(0);
  #ys = new Float64Array(0);
  #shown = new Uint8Array(0);

  constructor(box, candidates, state, name) {
    [this.#candidates, this.#state] = [candidates, state];
    for (const axis of ["across", "up"]) this.#add_select(axis);
    box.append(this.#axes, this.#canvas, this.#tip);
    box.classList.add("scatter");
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
    const select = document.getElementById(`scatter-${axis === "across" ? "x" : "y"}`);
    select.append(
      ...metrics_of(this.#candidates).map((metric) =>
        h("option", { value: metric.name }, axis_title(metric)),
      ),
    );
    select.value = this.#state.get(axis);
    select.addEventListener("change", () => this.#state.set(axis, select.value));
    this.#state.on(axis, (name) => {
      select.value = name;
      this.#draw();
    });
  }

  #listen() {
    const canvas = this.#canvas,
      pick = (row) => row >= 0 && this.#state.set("picked", this.#candidates.columns.draw[row]);
    canvas.addEventListener("click", (event) => pick(this.#nearest(event).row));
    canvas.addEventListener("pointermove", (event) => this.#tell(event));
    canvas.addEventListener("pointerleave", () => (this.#tip.hidden = true));
    canvas.addEventListener("keydown", (event) => {
      const row = with_modifier(event) ? null : this.#next(event.key);
      if (row === null) return;
      event.preventDefault();
      pick(row);
    });
    document.getElementById("scatter-front").addEventListener("change", () => this.#paint());
    this.#state.on("order", () => this.#paint());
    this.#state.on("picked", () => this.#paint());
    on_theme(() => this.#paint());
  }

  #metrics() {
    return ["across", "up"].map((axis) => metric_of[this.#state.get(axis)]);
  }

  #draw() {
    if (!this.#width) return;
    const [x_metric, y_metric] = this.#metrics();
    const values = [x_metric, y_metric].map(({ name, axis = 1 }) =>
      this.#candidates.columns[name].map((value) => (value === null ? null : value * axis)),
    );
    const plot = plot_with_room({
      width: this.#width,
      height: kHeight,
      ...kMargins,
      className: "plot",
      ariaHidden: "true",
      x: scale_of(x_metric, values[0]),
      y: scale_of(y_metric, values[1]),
      marks: [Plot.frame({ stroke: "var(--line)" })],
    });
    this.#axes.replaceChildren(plot);
    const [x, y] = [plot.scale("x"), plot.scale("y")];
    this.#xs = Float64Array.from(values[0], (value) => (value === null ? NaN : x.apply(value)));
    this.#ys = Float64Array.from(values[1], (value) => (value === null ? NaN : y.apply(value)));
    this.#paint();
  }

  #has_place(row) {
    return row !== undefined && !Number.isNaN(this.#xs[row] + this.#ys[row]);
  }

  /** Dots in their order: filtered out, shown, with details (rings), picked. */
  *#dots() {
    const { count: all, detailed, row_of } = this.#candidates,
      many = all > kMany,
      r = many ? 1.8 : 2.6;
    for (const [wanted, fill, opacity] of [
      [0, "ink-soft", 0.13],
      [1, "accent", many ? 0.4 : 0.65],
    ]) {
      for (let row = 0; row < all; ++row)
        if (this.#shown[row] === wanted && this.#has_place(row)) yield { row, r, fill, opacity };
    }
    for (const draw of detailed) {
      const row = row_of.get(draw);
      if (this.#shown[row] && this.#has_place(row)) yield { row, r: 4.5, stroke: "ink", wide: 1.5 };
    }
    const picked = row_of.get(this.#state.get("picked"));
    if (!this.#has_place(picked)) return;
    yield { row: picked, r: 5, fill: "pick", opacity: 1 };
    yield { row: picked, r: 9, stroke: "ink", wide: 2 };
  }

  #paint() {
    if (!this.#width) return;
    const ratio = devicePixelRatio || 1,
      order = this.#state.get("order") ?? [];
    this.#canvas.width = this.#width * ratio;
    this.#canvas.height = kHeight * ratio;
    this.#canvas.style.width = `${this.#width}px`;
    const pen = this.#canvas.getContext("2d");
    pen.scale(ratio, ratio);
    this.#shown = new Uint8Array(this.#candidates.count);
    for (const row of order) this.#shown[row] = 1;
    const inks = Object.fromEntries(
      ["ink-soft", "accent", "ink", "pick"].map((name) => [name, colour(name)]),
    );
    for (const { row, r, fill, opacity, stroke, wide } of this.#dots()) {
      pen.globalAlpha = opacity ?? 1;
      pen.beginPath();
      pen.arc(this.#xs[row], this.#ys[row], r, 0, 2 * Math.PI);
      if (fill) {
        pen.fillStyle = inks[fill];
        pen.fill();
      } else {
        pen.strokeStyle = inks[stroke];
        pen.lineWidth = wide;
        pen.stroke();
      }
    }
    const front = this.#front(order);
    this.#paint_front(pen, front);
    this.#say(order, front);
  }

  /** The Pareto front of the shown candidates, sorted by the first metric. */
  #front(order) {
    if (!document.getElementById("scatter-front").checked) return [];
    const placed = order.filter((row) => this.#has_place(row)),
      goals = this.#metrics().map(({ name, better }) => ({
        values: this.#candidates.columns[name],
        better,
      }));
    return front_of(placed, goals).sort((a, b) => this.#xs[a] - this.#xs[b]);
  }

  #paint_front(pen, front) {
    [pen.strokeStyle, pen.lineWidth, pen.globalAlpha] = [colour("ink"), 1.5, 1];
    pen.beginPath();
    for (const row of front) pen.lineTo(this.#xs[row], this.#ys[row]);
    pen.stroke();
  }

  #say(order, front) {
    const missing = order.filter((row) => !this.#has_place(row)).length;
    document.getElementById("scatter-note").textContent =
      `${plural(order.length - missing, "candidate")} shown` +
      (missing ? `, ${count(missing)} without a value on these axes` : "") +
      (order.length < this.#candidates.count ? "; faint: filtered out" : "") +
      ". Rings: all details in this report." +
      (front.length ? ` Line: Pareto front of ${plural(front.length, "candidate")}.` : "");
  }

  #nearest(event) {
    const frame = this.#canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) * this.#width) / frame.width,
      y = ((event.clientY - frame.top) * kHeight) / frame.height;
    let best = -1,
      least = Infinity;
    for (let row = 0; row < this.#xs.length; ++row) {
      const away = (this.#xs[row] - x) ** 2 + (this.#ys[row] - y) ** 2;
      if (this.#shown[row] && away < least) [best, least] = [row, away];
    }
    return { row: best, away: Math.sqrt(least) };
  }

  #tell(event) {
    const { row, away } = this.#nearest(event),
      tip = this.#tip;
    tip.hidden = row < 0 || away > kReach_px;
    if (tip.hidden) return;
    const line = (metric) =>
      `${metric.label} ${with_unit(metric, this.#candidates.columns[metric.name][row])}`;
    tip.textContent = [
      `draw ${this.#candidates.columns.draw[row]}`,
      ...this.#metrics().map(line),
    ].join("\n");
    tip.style.left = `${Math.min(this.#xs[row] + 12, this.#width - 190)}px`;
    tip.style.top = `${Math.max(0, this.#ys[row] - 62)}px`;
  }

  /**
   * The next row in an arrow's direction; equals are ordered by the other axis, then by their rows.
   */
  #next(key) {
    const way = {
      ArrowRight: [this.#xs, this.#ys, 1],
      ArrowLeft: [this.#xs, this.#ys, -1],
      ArrowUp: [this.#ys, this.#xs, -1],
      ArrowDown: [this.#ys, this.#xs, 1],
    }[key];
    if (!way) return null;
    const [along, other, sign] = way,
      at = this.#candidates.row_of.get(this.#state.get("picked"));
    const before = (a, b) => sign * (along[a] - along[b]) || other[a] - other[b] || a - b;
    let best = -1;
    for (let row = 0; row < this.#xs.length; ++row) {
      const further = at === undefined || before(row, at) > 0;
      if (!this.#shown[row] || !this.#has_place(row) || !further) continue;
      if (best < 0 || before(row, best) < 0) best = row;
    }
    return best;
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

  /** The axes, with the points until they are copied. */
  #drawing() {
    const plot = this.#axes.firstChild,
      points = h("svg:g", { "data-styled": "" });
    for (const { row, r, fill, opacity, stroke, wide } of this.#dots()) {
      points.append(
        h("svg:circle", {
          cx: this.#xs[row].toFixed(2),
          cy: this.#ys[row].toFixed(2),
          r,
          fill: fill ? colour(fill) : "none",
          "fill-opacity": opacity,
          stroke: stroke && colour(stroke),
          "stroke-width": wide,
        }),
      );
    }
    plot.append(points);
    queueMicrotask(() => points.remove());
    return plot;
  }
}

export const make_scatter = (box, candidates, state, name) =>
  new Scatter(box, candidates, state, name);
