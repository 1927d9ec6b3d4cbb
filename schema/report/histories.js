// Relative lengths of the diagonals along the folding, as figure 13b-d of the paper, and their list.
import * as Plot from "@observablehq/plot";
import { folding_chart, path_of, range } from "./chart.js";
import { fixed, h, signed_percent } from "./format.js";

const kHeight = 400;

/** Numbers at the lines' ends, pushed apart until they can be read. */
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

export function make_histories(box, caption, report, detail, decoded, state, end_deg) {
  const { diagonals, actuators } = report,
    all = range(0, decoded.samples - 1);
  let least = 1,
    most = 1;
  for (const k of all) {
    for (let d = 0; d < diagonals.length; ++d) {
      least = Math.min(least, decoded.relative(k, d));
      most = Math.max(most, decoded.relative(k, d));
    }
  }
  const spare = (most - least) * 0.06 || 0.01,
    limit = actuators.stroke_limit;
  const limits = limit
    ? [1 - limit, 1 + limit].filter(
        (value) => value > least - 0.3 * (most - least) && value < most + 0.3 * (most - least),
      )
    : [];
  const domain = [
    Math.min(least - spare, ...limits.map((v) => v - spare / 2)),
    Math.max(most + spare, ...limits.map((v) => v + spare / 2)),
  ];
  let paths = [],
    x = null,
    y = null;

  const chart = folding_chart({
    box,
    state,
    detail,
    decoded,
    end_deg,
    height: kHeight,
    label: "Relative lengths of the diagonals against the deployment ratio",
    room: diagonals.length <= 32 ? 0.055 : 0,
    y: { domain, label: "relative length L / L₀" },
    marks: [
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
    ],
    lines(svg, x_scale, y_scale) {
      [x, y] = [x_scale, y_scale];
      const point = (d) => (k) => [x.apply(decoded.deployment[k]), y.apply(decoded.relative(k, d))];
      const last = decoded.samples - 1,
        end_x = x.apply(decoded.deployment[decoded.depth]);
      const numbers = spread(
        diagonals.map((_, d) => y.apply(decoded.relative(decoded.depth, d))),
        11,
      );
      paths = diagonals.map((_, d) => {
        const group = h(
          "svg:g",
          { class: `history ${decoded.grows[d] ? "grows" : "shrinks"}`, "data-diagonal": d },
          h("svg:path", { d: path_of(range(0, decoded.depth), point(d)) }),
          decoded.depth < last
            ? h("svg:path", { class: "beyond", d: path_of(range(decoded.depth, last), point(d)) })
            : null,
          diagonals.length <= 32
            ? h(
                "svg:text",
                { x: (end_x - 24 - (d % 2) * 14).toFixed(1), y: (numbers[d] + 3.5).toFixed(1) },
                String(d + 1),
              )
            : null,
        );
        svg.append(group);
        return group;
      });
      svg.addEventListener("pointermove", (event) => {
        if (event.buttons) return;
        const frame = svg.getBoundingClientRect(),
          ratio = x.invert(event.clientX - frame.left);
        let k = 0;
        decoded.deployment.forEach((value, i) => {
          if (Math.abs(value - ratio) < Math.abs(decoded.deployment[k] - ratio)) k = i;
        });
        let best = null,
          nearest = 12;
        for (let d = 0; d < diagonals.length; ++d) {
          const away = Math.abs(y.apply(decoded.relative(k, d)) - (event.clientY - frame.top));
          if (away < nearest) [best, nearest] = [d, away];
        }
        state.set("diagonal", best);
      });
      svg.addEventListener("pointerleave", () => state.set("diagonal", null));
      mark(state.get("diagonal"));
    },
  });

  function mark(picked) {
    paths[0]?.parentNode.classList.toggle("has-picked", picked !== null);
    paths.forEach((group, d) => group.classList.toggle("picked", d === picked));
  }

  caption.textContent =
    "Solid: increasing as it folds; dashed: decreasing. Faint: beyond D. " +
    "Up to D (deploys from), every diagonal only grows or only shrinks; past it at least one thing is wrong. Press on a chart to go there.";
  return { ...chart, mark };
}

/** Each diagonal with its direction and elongation; focus or hover marks it in all views. */
export function make_diagonal_list(box, report, detail, decoded, state) {
  const few = new Set(detail.few?.diagonals ?? []),
    over = new Set(detail.over_stroke?.diagonals ?? []);
  const k_n_per_mm = report.actuators.stiffness_n_per_mm;
  const now = [],
    force = [];
  const rows = report.diagonals.map((diagonal, d) => {
    now.push(h("td", { class: "number" }));
    force.push(h("td", { class: "number" }));
    const name = h(
      "button",
      { type: "button", "data-diagonal": d },
      `${diagonal.from}–${diagonal.to}`,
    );
    const row = h(
      "tr",
      { class: decoded.grows[d] ? "grows" : "shrinks", "data-diagonal": d },
      h("td", { class: "number" }, String(d + 1)),
      h("td", {}, name),
      h(
        "td",
        { title: decoded.grows[d] ? "increasing as it folds" : "decreasing as it folds" },
        decoded.grows[d] ? "▲" : "▼",
      ),
      now[d],
      h("td", { class: "number" }, signed_percent(decoded.relative(decoded.depth, d) - 1)),
      force[d],
      h(
        "td",
        {},
        few.has(d)
          ? h("span", { title: "one of the smallest set that keeps half of the least moment" }, "★")
          : null,
        over.has(d)
          ? h("span", { title: `beyond the stroke limit somewhere up to D` }, " !")
          : null,
      ),
    );
    row.addEventListener("pointerenter", () => state.set("diagonal", d));
    row.addEventListener("pointerleave", () => state.set("diagonal", null));
    name.addEventListener("focus", () => state.set("diagonal", d));
    name.addEventListener("blur", () => state.set("diagonal", null));
    return row;
  });
  box.replaceChildren(
    h(
      "table",
      { class: "list" },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ...[
            ["", "number in the drawings"],
            ["diagonal", ""],
            ["", "direction as the sheet folds"],
            ["now", "elongation at the slider’s angle"],
            ["at D", "elongation at D"],
            ["force", "of its spring at the slider’s angle, N: positive where it pulls"],
            ["", ""],
          ].map(([words, about]) => h("th", { title: about }, words)),
        ),
      ),
      h("tbody", {}, rows),
    ),
  );
  return {
    move() {
      const k = state.get("sample");
      now.forEach((cell, d) => {
        const elongation = decoded.relative(k, d) - 1;
        cell.textContent = signed_percent(elongation);
        force[d].textContent = `${fixed(k_n_per_mm * decoded.flat_mm[d] * elongation, 1)} N`;
      });
    },
    mark(picked) {
      rows.forEach((row, d) => row.classList.toggle("picked", d === picked));
    },
  };
}
