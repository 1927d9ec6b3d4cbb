// Any two metrics of the candidates against each other: axes by Plot, points on a canvas, which stays
// quick with tens of thousands of them.
import * as Plot from "@observablehq/plot";
import { when_wide } from "./chart.js";
import { count, h, power, powers } from "./format.js";
import { axis_title, metrics, metric_of, with_unit } from "./metrics.js";
import { colour, on_theme } from "./theme.js";

const kHeight = 400,
  kMargins = { marginLeft: 66, marginRight: 16, marginTop: 14, marginBottom: 44 };

/** Positive values over more than three decades are read better on a logarithmic axis. */
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

export function make_scatter(box, candidates, state) {
  const present = metrics.filter((metric) => candidates.columns[metric.name]);
  const selects = ["scatter-x", "scatter-y"].map((id) => document.getElementById(id));
  const wanted = ["stroke_max", "slope_min_mm_per_deg"];
  selects.forEach((select, i) => {
    select.append(
      ...present.map((metric) => h("option", { value: metric.name }, axis_title(metric))),
    );
    select.value =
      metric_of[wanted[i]] && candidates.columns[wanted[i]] ? wanted[i] : present[i]?.name;
    select.addEventListener("change", () => draw());
  });
  const axes = h("div"),
    note = document.getElementById("scatter-note");
  const tip = h("output", { class: "tip", hidden: true, "aria-hidden": "true" });
  const canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "data-testid": "scatter-canvas",
    "aria-label":
      "Scatter of two metrics. Arrow keys go to the next candidate along the axes; a click picks the nearest.",
  });
  box.append(axes, canvas, tip);
  box.classList.add("scatter");

  let width = 0,
    xs = new Float64Array(0),
    ys = new Float64Array(0),
    shown = new Uint8Array(0);

  function draw() {
    if (!width) return;
    const [x_metric, y_metric] = selects.map((select) => metric_of[select.value]);
    const values = [x_metric, y_metric].map(({ name, axis = 1 }) =>
      candidates.columns[name].map((value) => (value === null ? null : value * axis)),
    );
    const plot = Plot.plot({
      width,
      height: kHeight,
      ...kMargins,
      className: "plot",
      ariaHidden: "true",
      x: scale_of(x_metric, values[0]),
      y: scale_of(y_metric, values[1]),
      marks: [Plot.frame({ stroke: "var(--line)" })],
    });
    axes.replaceChildren(plot);
    const [x, y] = [plot.scale("x"), plot.scale("y")];
    xs = Float64Array.from(values[0], (value) => (value === null ? NaN : x.apply(value)));
    ys = Float64Array.from(values[1], (value) => (value === null ? NaN : y.apply(value)));
    paint();
  }

  function paint() {
    if (!width) return;
    const ratio = devicePixelRatio || 1,
      order = state.get("order") ?? [];
    canvas.width = width * ratio;
    canvas.height = kHeight * ratio;
    canvas.style.width = `${width}px`;
    const pen = canvas.getContext("2d");
    pen.scale(ratio, ratio);
    shown = new Uint8Array(candidates.count);
    for (const row of order) shown[row] = 1;
    const radius = candidates.count > 3000 ? 1.8 : 2.6;
    let missing = 0;
    // Those that the filter leaves out stay as faint context; where many meet, the colour deepens.
    for (const [wanted, ink, alpha] of [
      [0, colour("ink-soft"), 0.13],
      [1, colour("accent"), candidates.count > 3000 ? 0.4 : 0.65],
    ]) {
      pen.fillStyle = ink;
      pen.globalAlpha = alpha;
      for (let row = 0; row < candidates.count; ++row) {
        if (shown[row] !== wanted) continue;
        if (Number.isNaN(xs[row] + ys[row])) {
          missing += wanted;
          continue;
        }
        pen.beginPath();
        pen.arc(xs[row], ys[row], radius, 0, 2 * Math.PI);
        pen.fill();
      }
    }
    pen.globalAlpha = 1;
    pen.lineWidth = 1.5;
    pen.strokeStyle = colour("ink");
    for (const draw_number of candidates.detailed) {
      const row = candidates.row_of.get(draw_number);
      if (row !== undefined && shown[row] && !Number.isNaN(xs[row] + ys[row])) ring(pen, row, 4.5);
    }
    const picked = candidates.row_of.get(state.get("picked"));
    if (picked !== undefined && !Number.isNaN(xs[picked] + ys[picked])) {
      pen.fillStyle = colour("pick");
      pen.beginPath();
      pen.arc(xs[picked], ys[picked], 5, 0, 2 * Math.PI);
      pen.fill();
      pen.lineWidth = 2;
      ring(pen, picked, 9);
    }
    note.textContent =
      `${count(order.length - missing)} candidates shown` +
      (missing ? `, ${count(missing)} without a value on these axes` : "") +
      (order.length < candidates.count ? "; faint: those the filter leaves out" : "") +
      ". Ringed: with all details in this report.";
  }

  function ring(pen, row, radius) {
    pen.beginPath();
    pen.arc(xs[row], ys[row], radius, 0, 2 * Math.PI);
    pen.stroke();
  }

  function nearest(event) {
    const frame = canvas.getBoundingClientRect();
    const x = ((event.clientX - frame.left) * width) / frame.width,
      y = ((event.clientY - frame.top) * kHeight) / frame.height;
    let best = -1,
      least = Infinity;
    for (let row = 0; row < xs.length; ++row) {
      const away = (xs[row] - x) ** 2 + (ys[row] - y) ** 2;
      if (shown[row] && away < least) [best, least] = [row, away];
    }
    return { row: best, away: Math.sqrt(least) };
  }

  canvas.addEventListener("click", (event) => {
    const { row } = nearest(event);
    if (row >= 0) state.set("picked", candidates.columns.draw[row]);
  });
  canvas.addEventListener("pointermove", (event) => {
    const { row, away } = nearest(event);
    tip.hidden = row < 0 || away > 24;
    if (tip.hidden) return;
    const [x_metric, y_metric] = selects.map((select) => metric_of[select.value]);
    tip.textContent =
      `draw ${candidates.columns.draw[row]}\n${x_metric.label} ${with_unit(x_metric, candidates.columns[x_metric.name][row])}\n` +
      `${y_metric.label} ${with_unit(y_metric, candidates.columns[y_metric.name][row])}`;
    tip.style.left = `${Math.min(xs[row] + 12, width - 190)}px`;
    tip.style.top = `${Math.max(0, ys[row] - 62)}px`;
  });
  canvas.addEventListener("pointerleave", () => (tip.hidden = true));
  canvas.addEventListener("keydown", (event) => {
    const way = {
      ArrowRight: [xs, ys, 1],
      ArrowLeft: [xs, ys, -1],
      ArrowUp: [ys, xs, -1],
      ArrowDown: [ys, xs, 1],
    }[event.key];
    if (!way) return;
    event.preventDefault();
    const [along, other, sign] = way,
      at = candidates.row_of.get(state.get("picked"));
    let best = -1;
    // The next one in this direction; equals are told apart by the other axis, then by the order.
    const before = (a, b) => sign * (along[a] - along[b]) || other[a] - other[b] || a - b;
    for (let row = 0; row < xs.length; ++row) {
      if (
        !shown[row] ||
        Number.isNaN(xs[row] + ys[row]) ||
        (at !== undefined && before(row, at) <= 0)
      )
        continue;
      if (best < 0 || before(row, best) < 0) best = row;
    }
    if (best >= 0) state.set("picked", candidates.columns.draw[best]);
  });

  when_wide(box, (now) => {
    width = now;
    draw();
  });
  state.on("order", paint);
  state.on("picked", paint);
  on_theme(paint);
}
