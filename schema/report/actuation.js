// Charts the springs' energy, their moment about the pilot crease and the mechanical advantage, and
// says the conclusions.
import * as Plot from "@observablehq/plot";
import { deployment, folding_chart, kHalo, path_of, range } from "./chart.js";
import { degrees, extent, fixed, h, number, percent, plural, power, powers } from "./format.js";
import { single } from "./save.js";
import { is_pattern } from "./page_kind.js";

const kHeight = 270;

const kHeadroom = 3, // factor above the largest value on a logarithmic scale, for words
  kNoise = 0.01, // share of the range below which negative values get no room
  kDecades = 100; // ratio from which a linear scale hides the least values

/** The last sample that sets a scale: near the fold limit values may diverge. */
const last_looked_at = (decoded) => Math.max(decoded.depth, 0.9 * (decoded.samples - 1));

function domain_of(values, decoded) {
  const [least, most] = extent([0, ...values.slice(0, last_looked_at(decoded) + 1)]);
  const spare = (most - least) * 0.12 || 1;
  return [least < -kNoise * (most - least) ? least - spare : 0, most + spare];
}

/** The domain of a logarithmic scale: from the least positive value between 5 degrees and D. */
function log_domain_of(values, decoded, from_deg = 5) {
  let least = Infinity,
    most = 0;
  for (let k = 0; k <= last_looked_at(decoded); ++k) {
    if (!(values[k] > 0)) continue;
    most = Math.max(most, values[k]);
    if (decoded.pilot_deg[k] >= from_deg && k <= Math.max(decoded.depth, 1))
      least = Math.min(least, values[k]);
  }
  return least < most ? [least / 2, most * kHeadroom] : null;
}

/** Returns whether values are positive from 5 degrees to D and span too much for a linear scale. */
function wants_log(values, decoded, from_deg = 5) {
  const domain = log_domain_of(values, decoded);
  const positive = decoded.pilot_deg.every(
    (pilot_deg, k) => pilot_deg < from_deg || k > decoded.depth || values[k] > 0,
  );
  return domain !== null && positive && domain[1] / kHeadroom > kDecades * 2 * domain[0];
}

function value_chart({ folding, values, label, unit, marks, log }) {
  const { state, decoded } = folding;
  let dot = null,
    readout = null,
    x = null,
    y = null;
  const title = `${label}${unit ? ` (${unit})` : ""}${log ? ", log scale" : ""}`;
  const chart = folding_chart({
    ...folding,
    height: kHeight,
    label: `${label} against the deployment ratio`,
    y: log
      ? { type: "log", domain: log, ticks: powers(...log), tickFormat: power, label: title }
      : { domain: domain_of(values, decoded), label: title },
    marks: [log ? null : Plot.ruleY([0], { stroke: "var(--ink-soft)" }), ...(marks ?? [])],
    lines(svg, x_scale, y_scale) {
      [x, y] = [x_scale, y_scale];
      // Values outside the domain are not drawn.
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

function weakest_marks(weakest, log) {
  if (!weakest) return [];
  const place = { x: (w) => deployment(w.pilot_deg), y: "moment_n_mm" };
  return [
    Plot.dot([weakest], { ...place, symbol: "triangle", r: 5, fill: "var(--over-folded)" }),
    Plot.text([weakest], {
      ...place,
      text: () => "weakest",
      dy: log ? 4 : -12,
      dx: log ? -10 : 0,
      ...kHalo,
      textAnchor: log || weakest.pilot_deg < 90 ? "end" : "start",
    }),
  ];
}

const at_flat = ({ diagonals }) => {
  const preloads_n = diagonals.map(({ preload_n }) => preload_n);
  const [least_n, most_n] = extent(preloads_n);
  if (!most_n) return "relaxed when flat";
  const each = least_n === most_n ? `${number(most_n)} N` : `up to ${number(most_n)} N`;
  return `preload ${each}`;
};

const quantities = (decoded) => [
  { id: "energy", values: decoded.energy_n_mm, label: "energy", unit: "N mm", log: "energy-log" },
  { id: "moment", values: decoded.moment_n_mm, label: "moment", unit: "N mm", log: "moment-log" },
  {
    id: "advantage",
    values: decoded.mechanical_advantage,
    label: "mechanical advantage (N/N)",
    unit: "",
  },
];

/**
 * Charts with their boxes. The moment has a logarithmic scale where a linear one would hide the
 * weakest point, unless the reader chose; `change` is called with a chart that must be drawn again.
 */
export function make_actuation(report, folding, change) {
  const { detail, decoded } = folding,
    box_of = (id) => document.getElementById(id);
  box_of("energy-caption").textContent =
    (report.actuators.equal_springs
      ? `E = ½ k Σ (L − L₀)² of springs on all diagonals: k = ${number(report.actuators.stiffness_n_per_mm)} N/mm, ${at_flat(report)}`
      : `E of ${report.actuators.words}`) + ". 1 N mm = 1 mJ.";
  box_of("moment-caption").textContent =
    `M = dE/dφ, φ the pilot angle. Where it is positive, the ${report.actuators.parts} unfold the sheet.`;
  return quantities(decoded).map(({ id, values, label, unit, log }) => {
    const toggle = log && box_of(log);
    if (toggle && toggle.dataset.said === undefined)
      toggle.checked = id === "moment" && wants_log(values, decoded);
    const make = () =>
      value_chart({
        folding,
        values,
        label,
        unit,
        marks: id === "moment" ? weakest_marks(detail.weakest, toggle.checked) : [],
        log: toggle?.checked ? log_domain_of(values, decoded) : null,
      });
    const entry = { box: box_of(id), chart: make() };
    if (toggle)
      toggle.onchange = () => {
        toggle.dataset.said = "";
        entry.chart = make();
        change(entry);
      };
    return entry;
  });
}

const kColumns = {
  energy: "energy_n_mm",
  moment: "moment_n_mm",
  advantage: "mechanical_advantage",
};

/** A chart's data, one row for each sample. */
export const actuation_rows = (id, decoded) => ({
  heads: ["pilot_deg", "deployment_ratio", kColumns[id]],
  rows: decoded.pilot_deg.map((pilot_deg, k) => [
    pilot_deg,
    single(decoded.deployment[k]),
    single(decoded[kColumns[id]][k]),
  ]),
});

const names_of = (report, list) =>
  list.map((d) => `${d} (${report.diagonals[d].from}–${report.diagonals[d].to})`).join(", ");

const bold = (words, ...rest) => h("span", {}, h("strong", {}, words), ...rest);

// The least angle at which the moment counts: at a stop it is none.
const counts_from = ({ from_deg = 5 }) => degrees(from_deg);

function weakest_words({ weakest }) {
  if (!weakest) return null;
  return bold(
    "Weakest point: ",
    `least moment between ${counts_from(weakest)} and D: ${number(weakest.moment_n_mm)} N mm at a pilot angle of ${degrees(weakest.pilot_deg)}. ` +
      "Moments of friction and crease stiffness must stay below it.",
  );
}

function fewest_words({ few, weakest }, report) {
  if (!few)
    return weakest && report.actuators.equal_springs
      ? `No set of fewest springs: the moment is not positive at all angles from ${counts_from(weakest)} to D.`
      : null;
  const { diagonals, share, proven } = few;
  return bold(
    "Fewest springs: ",
    `${plural(diagonals.length, "spring")} on ${names_of(report, diagonals)} alone ${diagonals.length === 1 ? "keeps" : "keep"} ${percent(share, 2)} of the least moment. ` +
      (proven
        ? "No smaller set keeps half of it."
        : "No smaller set that keeps half of it is known, but none is ruled out."),
  );
}

function stroke_words({ over_stroke }, report) {
  const { stroke_limit } = report.actuators;
  if (!stroke_limit) {
    const ways = is_pattern(report)
      ? "--stroke-limit sets one."
      : "“design.springs.stroke_limit” in the campaign file, or --stroke-limit, sets one.";
    return `No stroke limit; ${ways}`;
  }
  const limit = `±${percent(stroke_limit, 2)}`;
  if (!over_stroke) return `Stroke limit of ${limit}: no diagonal exceeds it.`;
  return bold(
    "Stroke limit ",
    `of ${limit}: first exceeded at ${degrees(over_stroke.from_deg)}, and up to D by ${plural(over_stroke.diagonals.length, "diagonal")}: ` +
      `${names_of(report, over_stroke.diagonals)}. With actuators of this stroke the sheet deploys from the sample before, not from D.`,
  );
}

export function show_actuation_words(box, report, detail, decoded) {
  const { stiffness_n_per_mm, equal_springs, words } = report.actuators,
    at_D = decoded.mechanical_advantage[decoded.depth];
  const items = [
    `Strain energy at D = ${degrees(detail.verdict.deploys_from_deg)}: ${number(decoded.energy_n_mm[decoded.depth])} N mm (mJ) in ` +
      (equal_springs
        ? `${plural(report.diagonals.length, "spring")} of ${number(stiffness_n_per_mm)} N/mm, one on each diagonal.`
        : `${words}.`),
    weakest_words(detail),
    fewest_words(detail, report),
    stroke_words(detail, report),
    Number.isFinite(at_D) ? `Mechanical advantage at D: ${fixed(at_D, 3)} N/N.` : null,
  ];
  const list = items.filter((item) => item !== null).map((item) => h("li", {}, item));
  box.replaceChildren(h("ul", { class: "words" }, list));
}
