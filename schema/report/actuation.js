// What springs on the diagonals do along the way: energy, moment about the pilot crease, mechanical
// advantage, and what follows from them in words.
import * as Plot from "@observablehq/plot";
import { folding_chart, deployment, path_of, range } from "./chart.js";
import { degrees, fixed, h, number, percent, plural, power, powers } from "./format.js";

const kHeight = 270;

/** The range of the values up to D or most of the way: towards the fold limit they may run away. */
function domain_of(values, decoded) {
  let least = 0,
    most = 0;
  for (let k = 0; k <= Math.max(decoded.depth, 0.9 * (decoded.samples - 1)); ++k) {
    if (!Number.isFinite(values[k])) continue;
    least = Math.min(least, values[k]);
    most = Math.max(most, values[k]);
  }
  const spare = (most - least) * 0.12 || 1;
  return [least < 0 ? least - spare : 0, most + spare];
}

/** The same on a logarithmic scale: from the least positive value between 5 degrees and D. */
function log_domain_of(values, decoded, from_deg = 5) {
  let least = Infinity,
    most = 0;
  for (let k = 0; k <= Math.max(decoded.depth, 0.9 * (decoded.samples - 1)); ++k) {
    if (!(values[k] > 0)) continue;
    most = Math.max(most, values[k]);
    if (decoded.pilot_deg[k] >= from_deg) least = Math.min(least, values[k]);
  }
  return least < most ? [least / 2, most * 1.5] : null;
}

function value_chart({ box, folding, values, label, unit, marks, log }) {
  const { state, decoded } = folding;
  let dot = null,
    readout = null,
    x = null,
    y = null;
  const title = `${label}${unit ? ` (${unit})` : ""}${log ? ", log scale" : ""}`;
  const chart = folding_chart({
    ...folding,
    box,
    height: kHeight,
    label: `${label} against the deployment ratio`,
    y: log
      ? { type: "log", domain: log, ticks: powers(...log), tickFormat: power, label: title }
      : { domain: domain_of(values, decoded), label: title },
    marks: [log ? null : Plot.ruleY([0], { stroke: "var(--ink-soft)" }), ...(marks ?? [])],
    lines(svg, x_scale, y_scale) {
      [x, y] = [x_scale, y_scale];
      // What leaves the frame beyond D is cut off there.
      const point = (k) => [
        x.apply(decoded.deployment[k]),
        values[k] >= y.domain[0] && values[k] <= y.domain[1] ? y.apply(values[k]) : NaN,
      ];
      svg.append(
        h("svg:path", { class: "value", d: path_of(range(0, decoded.depth), point) }),
        h("svg:path", {
          class: "value beyond",
          d: path_of(range(decoded.depth, decoded.samples - 1), point),
        }),
      );
      dot = h("svg:circle", { class: "value-dot", r: 4 });
      readout = h("svg:text", { class: "readout", "text-anchor": "end", x: x.range[1], y: 12 });
      svg.append(dot, readout);
    },
  });
  const move = () => {
    chart.move();
    if (!dot) return;
    const k = state.get("sample"),
      value = values[k];
    const inside = Number.isFinite(value) && value >= y.domain[0] && value <= y.domain[1];
    dot.style.display = inside ? "" : "none";
    if (inside) {
      dot.setAttribute("cx", x.apply(decoded.deployment[k]));
      dot.setAttribute("cy", y.apply(value));
    }
    readout.textContent = `at ${degrees(decoded.pilot_deg[k])}: ${number(value)}${unit ? ` ${unit}` : ""}`;
  };
  const draw = (width) => {
    const plot = chart.draw(width);
    move();
    return plot;
  };
  return { draw, move };
}

export function make_actuation(report, detail, decoded, state, end_deg) {
  const { stiffness_n_per_mm } = report.actuators,
    boxes = (id) => document.getElementById(id);
  const folding = { state, detail, decoded, end_deg };
  // Energy and moment begin at nothing: near flat only a logarithmic scale shows them.
  const log_of = (values) =>
    document.getElementById("log").checked ? log_domain_of(values, decoded) : null;
  const weakest = detail.weakest
    ? [
        Plot.dot([detail.weakest], {
          x: (w) => deployment(w.pilot_deg),
          y: "moment_n_mm",
          symbol: "triangle",
          r: 5,
          fill: "var(--over-folded)",
        }),
        Plot.text([detail.weakest], {
          x: (w) => deployment(w.pilot_deg),
          y: "moment_n_mm",
          text: () => "weakest",
          dy: -12,
          fill: "var(--ink)",
          stroke: "var(--card)",
          strokeWidth: 4,
          textAnchor: detail.weakest.pilot_deg < 90 ? "end" : "start",
        }),
      ]
    : [];
  boxes("energy-caption").textContent =
    `Springs of ${number(stiffness_n_per_mm)} N/mm on all diagonals, relaxed on the flat sheet: ½ k Σ (L − L₀)². 1 N mm = 1 mJ.`;
  boxes("moment-caption").textContent =
    "dE/d(pilot angle). Positive: the springs unfold the sheet; at zero they could not.";
  return [
    [
      boxes("energy"),
      value_chart({
        folding,
        box: boxes("energy"),
        values: decoded.energy_n_mm,
        label: "energy",
        unit: "N mm",
        log: log_of(decoded.energy_n_mm),
      }),
    ],
    [
      boxes("moment"),
      value_chart({
        folding,
        box: boxes("moment"),
        values: decoded.moment_n_mm,
        label: "moment",
        unit: "N mm",
        marks: weakest,
        log: log_of(decoded.moment_n_mm),
      }),
    ],
    [
      boxes("advantage"),
      value_chart({
        folding,
        box: boxes("advantage"),
        values: decoded.mechanical_advantage,
        label: "mechanical advantage (N per N)",
        unit: "",
      }),
    ],
  ];
}

export function show_actuation_words(box, report, detail, decoded) {
  const { stiffness_n_per_mm, stroke_limit } = report.actuators,
    names = (list) =>
      list
        .map((d) => `${d + 1} (${report.diagonals[d].from}–${report.diagonals[d].to})`)
        .join(", ");
  const items = [];
  const D = degrees(detail.verdict.deploys_from_deg);
  items.push(
    `Folded to D = ${D}, springs of ${number(stiffness_n_per_mm)} N/mm on all ${report.diagonals.length} diagonals store ${number(decoded.energy_n_mm[decoded.depth])} N mm (mJ).`,
  );
  if (detail.weakest) {
    items.push(
      h(
        "span",
        {},
        h("strong", {}, "Weakest point: "),
        `at a pilot angle of ${degrees(detail.weakest.pilot_deg)} they give the least moment between 5° and D, ${number(detail.weakest.moment_n_mm)} N mm. ` +
          "Friction and the creases’ own stiffness must stay below it.",
      ),
    );
  }
  if (detail.few) {
    const { diagonals, share, proven } = detail.few;
    items.push(
      h(
        "span",
        {},
        h("strong", {}, "Fewest springs: "),
        `${plural(diagonals.length, "diagonal")} alone, ${names(diagonals)}, ${diagonals.length === 1 ? "keeps" : "keep"} ${percent(share, 2)} of the least moment. ` +
          (proven
            ? "No smaller set keeps half of it."
            : "A smaller set that keeps half of it was not found, but is not ruled out."),
      ),
    );
  }
  if (!detail.few && detail.weakest)
    items.push("No set of fewest springs: the moment is not positive all the way.");
  if (!stroke_limit)
    items.push(
      "No stroke limit was given; “actuators.stroke_limit” in the campaign file sets one.",
    );
  else if (detail.over_stroke) {
    items.push(
      h(
        "span",
        {},
        h("strong", {}, "Stroke limit "),
        `of ±${percent(stroke_limit, 2)}: first exceeded at ${degrees(detail.over_stroke.from_deg)}, and up to D by ${plural(detail.over_stroke.diagonals.length, "diagonal")}: ` +
          `${names(detail.over_stroke.diagonals)}. With actuators of that stroke it deploys from the sample before, not from D.`,
      ),
    );
  } else items.push(`Stroke limit of ±${percent(stroke_limit, 2)}: kept by every diagonal.`);
  const at_D = decoded.mechanical_advantage[decoded.depth];
  if (Number.isFinite(at_D))
    items.push(`At D one newton in every diagonal gives ${fixed(at_D, 3)} N on the sheet’s span.`);
  box.replaceChildren(
    h(
      "ul",
      { class: "words" },
      items.map((item) => h("li", {}, item)),
    ),
  );
}
