// Charts the relative lengths of the diagonals during the folding, as figure 13b-d of the paper,
// and lists the diagonals.
import * as Plot from "@observablehq/plot";
import { folding_chart, nearest_sample, path_of, range } from "./chart.js";
import { extent, fixed, h, signed_percent, table } from "./format.js";
import { single } from "./save.js";

const kHeight = 400;

/** Pushes numbers at the lines' ends apart until they do not overlap. */
function spread(places, least_px) {
  const order = places.map((_, i) => i).sort((a, b) => places[a] - places[b]);
  const out = [...places];
  for (let pass = 0; pass < 60; ++pass) {
    for (let i = 1; i < order.length; ++i) {
      const overlap = least_px - (out[order[i]] - out[order[i - 1]]);
      if (overlap <= 0) continue;
      out[order[i]] += overlap / 2;
      out[order[i - 1]] -= overlap / 2;
    }
  }
  return out;
}

const kNumbered = 32, // more diagonals than that have no numbers at their lines' ends
  kReach_px = 12;

/** The domain of the relative lengths, with the stroke limits that are near. */
function range_of(decoded, diagonals, limit) {
  const lengths = range(0, decoded.samples - 1).flatMap((k) =>
    diagonals.map((_, d) => decoded.relative(k, d)),
  );
  const [least, most] = extent([1, ...lengths]);
  const spare = (most - least) * 0.06 || 0.01,
    near = 0.3 * (most - least);
  const limits = (limit ? [1 - limit, 1 + limit] : []).filter(
    (value) => value > least - near && value < most + near,
  );
  return {
    limits,
    domain: [
      Math.min(least - spare, ...limits.map((v) => v - spare / 2)),
      Math.max(most + spare, ...limits.map((v) => v + spare / 2)),
    ],
  };
}

const limit_marks = (limits) => [
  Plot.ruleY([1], { stroke: "var(--ink-soft)" }),
  Plot.ruleY(limits, { stroke: "var(--mountain)", strokeDasharray: "1 3", strokeWidth: 1.5 }),
  Plot.text(limits, {
    y: (v) => v,
    frameAnchor: "right",
    textAnchor: "end",
    dy: -7,
    dx: -4,
    text: (v) => `stroke limit ${signed_percent(v - 1, 1)}`,
    fill: "var(--ink-soft)",
  }),
];

/** A line for each diagonal, with its number at D. */
function history_lines(decoded, diagonals, x, y) {
  const last = decoded.samples - 1,
    end_x = x.apply(decoded.deployment[decoded.depth]);
  const point = (d) => (k) => [x.apply(decoded.deployment[k]), y.apply(decoded.relative(k, d))];
  const numbers = spread(
    diagonals.map((_, d) => y.apply(decoded.relative(decoded.depth, d))),
    11,
  );
  return diagonals.map((_, d) =>
    h(
      "svg:g",
      { class: `history ${decoded.grows[d] ? "grows" : "shrinks"}`, "data-diagonal": d },
      h("svg:path", { d: path_of(range(0, decoded.depth), point(d)) }),
      decoded.depth < last
        ? h("svg:path", { class: "beyond", d: path_of(range(decoded.depth, last), point(d)) })
        : null,
      diagonals.length <= kNumbered
        ? h(
            "svg:text",
            { x: (end_x - 24 - (d % 2) * 14).toFixed(1), y: (numbers[d] + 3.5).toFixed(1) },
            String(d),
          )
        : null,
    ),
  );
}

/** The diagonal whose line is under the pointer, or null. */
function nearest_line(event, svg, decoded, diagonals, x, y) {
  const frame = svg.getBoundingClientRect(),
    k = nearest_sample(decoded, x.invert(event.clientX - frame.left));
  let best = null,
    nearest = kReach_px;
  for (let d = 0; d < diagonals.length; ++d) {
    const away = Math.abs(y.apply(decoded.relative(k, d)) - (event.clientY - frame.top));
    if (away < nearest) [best, nearest] = [d, away];
  }
  return best;
}

export function make_histories(caption, report, folding) {
  const { diagonals, actuators } = report,
    { decoded, state } = folding,
    { limits, domain } = range_of(decoded, diagonals, actuators.stroke_limit);
  let paths = [];
  const mark = (picked) => {
    paths[0]?.parentNode.classList.toggle("has-picked", picked !== null);
    paths.forEach((group, d) => group.classList.toggle("picked", d === picked));
  };
  const chart = folding_chart({
    ...folding,
    height: kHeight,
    label: "Relative lengths of the diagonals against the deployment ratio",
    room_px: diagonals.length <= kNumbered ? 54 : 0,
    y: { domain, label: "relative length L / L₀" },
    marks: limit_marks(limits),
    lines(svg, x, y) {
      paths = history_lines(decoded, diagonals, x, y);
      svg.append(...paths);
      svg.addEventListener("pointermove", (event) => {
        if (!event.buttons)
          state.set("diagonal", nearest_line(event, svg, decoded, diagonals, x, y));
      });
      svg.addEventListener("pointerleave", () => state.set("diagonal", null));
      mark(state.get("diagonal"));
    },
  });
  caption.textContent =
    "Solid: increasing as the sheet folds; dashed: decreasing; faint: beyond D. " +
    "Up to D every diagonal is monotone; beyond it there is a fault. A click on a chart moves the slider.";
  return { ...chart, mark };
}

/** The chart's data: relative lengths of all diagonals, one row for each sample. */
export function history_rows(report, decoded) {
  return {
    heads: [
      "pilot_deg",
      "deployment_ratio",
      ...report.diagonals.map(({ from, to }, d) => `relative_length_${d}_${from}-${to}`),
    ],
    rows: decoded.pilot_deg.map((pilot_deg, k) => [
      pilot_deg,
      single(decoded.deployment[k]),
      ...report.diagonals.map((_, d) => single(decoded.relative(k, d))),
    ]),
  };
}

const kHeads = [
  ["no.", "number in drawings, catalogue and exports"],
  ["diagonal"],
  ["±", "change of length as the sheet folds"],
  ["now", "elongation at the slider’s pilot angle"],
  ["at D", "elongation at D"],
  ["force", "spring force at the slider’s pilot angle, N; positive: tension"],
  [""],
];

function diagonal_row(diagonal, d, detail, decoded, state) {
  const number = () => h("td", { class: "number" }),
    cells = { now: number(), force: number() };
  const name = h(
    "button",
    { type: "button", "data-diagonal": d },
    `${diagonal.from}–${diagonal.to}`,
  );
  const grows = decoded.grows[d];
  const row = h(
    "tr",
    { class: grows ? "grows" : "shrinks", "data-diagonal": d },
    h("td", { class: "number" }, String(d)),
    h("td", {}, name),
    h(
      "td",
      { title: grows ? "increasing as it folds" : "decreasing as it folds" },
      grows ? "▲" : "▼",
    ),
    cells.now,
    h("td", { class: "number" }, signed_percent(decoded.relative(decoded.depth, d) - 1)),
    cells.force,
    h(
      "td",
      {},
      detail.few?.diagonals.includes(d)
        ? h("span", { title: "in the smallest set that keeps half of the least moment" }, "★")
        : null,
      detail.over_stroke?.diagonals.includes(d)
        ? h("span", { title: "exceeds the stroke limit below D" }, " !")
        : null,
    ),
  );
  row.addEventListener("pointerenter", () => state.set("diagonal", d));
  row.addEventListener("pointerleave", () => state.set("diagonal", null));
  name.addEventListener("focus", () => state.set("diagonal", d));
  name.addEventListener("blur", () => state.set("diagonal", null));
  return { row, ...cells };
}

/** Lists each diagonal's direction and elongation; focus or hover marks it in all views. */
export function make_diagonal_list(box, report, detail, decoded, state) {
  const { stiffness_n_per_mm: k_n_per_mm } = report.actuators;
  const rows = report.diagonals.map((diagonal, d) =>
    diagonal_row(diagonal, d, detail, decoded, state),
  );
  box.replaceChildren(
    table(
      { class: "list" },
      kHeads,
      rows.map(({ row }) => row),
    ),
  );
  return {
    move() {
      const k = state.get("sample");
      rows.forEach(({ now, force }, d) => {
        const elongation = decoded.relative(k, d) - 1;
        now.textContent = signed_percent(elongation);
        const { preload_n } = report.diagonals[d];
        const at_flat = decoded.grows[d] ? preload_n : -preload_n;
        const force_n = decoded.force_n
          ? decoded.force_n[k * rows.length + d]
          : at_flat + k_n_per_mm * decoded.flat_mm[d] * elongation;
        force.textContent = `${fixed(force_n, 1)} N`;
      });
    },
    mark(picked) {
      rows.forEach(({ row }, d) => row.classList.toggle("picked", d === picked));
    },
  };
}
