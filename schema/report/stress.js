// Shows CalculiX's results for the sheet with elastic panels (`misalign stress`): the largest
// stress of each panel, and the motion beside that of rigid panels.
import * as Plot from "@observablehq/plot";
import { plot_with_room } from "./chart.js";
import { by_id, degrees, h, number } from "./format.js";
import { stress_colours } from "./panel_paint.js";
import { add_saving, single } from "./save.js";
import { panel_name, place_name } from "./sheet.js";
import { on_theme } from "./theme.js";
import { file_stem } from "./page_kind.js";

const kHeight = 260;

const fact = (value, words) =>
  h("div", {}, h("dt", {}, words), h("dd", {}, h("strong", {}, value)));

/** The outcome: [time, label]. */
function outcome_of({ outcome, deployed_s }, decoded) {
  const last_s = `${number(decoded.stress.motion.at(-1)[0])} s`;
  if (deployed_s !== null) return [`${number(deployed_s)} s`, "deployed after"];
  if (outcome === "failed") return [last_s, "not deployed; CalculiX failed at this time"];
  return outcome === "stopped"
    ? [last_s, "not deployed; run stopped at this time"]
    : [last_s, "not deployed; end of the run"];
}

function where_of({ largest }) {
  if (!largest) return "no node outside the discs: the mesh is too coarse";
  const { time_s, panel, x_mm, y_mm } = largest;
  return `largest von Mises stress: at ${number(time_s)} s in panel ${place_name(panel)}, at (${number(x_mm)}, ${number(y_mm)}) mm of the flat sheet`;
}

function show_facts(detail, decoded) {
  const { stress } = detail,
    { material, thickness_mm, elements_a_side, disc_mm } = stress,
    [when, what] = outcome_of(stress, decoded);
  by_id("stress-facts").replaceChildren(
    fact(stress.largest ? `${number(stress.largest.stress_mpa)} MPa` : "–", where_of(stress)),
    fact(when, what),
    fact(`${elements_a_side} × ${elements_a_side}`, "shell elements per panel"),
    fact(
      material.name,
      `panel thickness ${number(thickness_mm)} mm, Young’s modulus ${number(material.e_gpa)} GPa`,
    ),
  );
  by_id("stress-caption").textContent =
    `Elastic panels by CalculiX, released from ${degrees(stress.from_deg)} with springs of ${number(stress.stiffness_n_per_mm)} N/mm. ` +
    `Stresses within ${number(disc_mm)} mm of a vertex are left out: springs and ball joints act at points, where the stress diverges as the mesh is refined.`;
}

/** Lists the panels by their largest stress, descending. */
function show_panels(sheet, panels_mpa) {
  const order = panels_mpa.map((_, i) => i).sort((a, b) => panels_mpa[b] - panels_mpa[a]);
  const chips = new Map(order.map((panel) => [panel, h("i")]));
  const recolour = () => {
    const colours = stress_colours(panels_mpa);
    chips.forEach((chip, panel) => (chip.style.background = colours[panel]));
  };
  by_id("stress-panels").replaceChildren(
    ...order.map((panel) =>
      h(
        "li",
        {},
        chips.get(panel),
        `${panel_name(sheet, panel)}: ${panels_mpa[panel] > 0 ? `${number(panels_mpa[panel])} MPa` : "–"}`,
      ),
    ),
  );
  recolour();
  return recolour;
}

let recolour_panels = () => {};
on_theme(() => recolour_panels());

const time_axis = (end_s) => ({
  label: "time (s)",
  labelAnchor: "center",
  labelArrow: "none",
  grid: true,
  domain: [0, end_s],
});

const deployed_marks = (deployed_s) =>
  deployed_s === null
    ? []
    : [
        Plot.ruleX([deployed_s], { stroke: "var(--ink)", strokeDasharray: "2 3" }),
        Plot.text(["deployed"], {
          x: () => deployed_s,
          frameAnchor: "top",
          dx: -5,
          dy: 3,
          textAnchor: "end",
          fill: "var(--ink)",
          stroke: "var(--card)",
          strokeWidth: 4,
        }),
      ];

const tip_of = (points, words) =>
  Plot.tip(points, Plot.pointerX({ x: "0", y: "1", title: ([time, value]) => words(time, value) }));

const frame = (width, label) => ({
  width,
  height: kHeight,
  marginLeft: 66,
  marginRight: 14,
  marginTop: 28,
  marginBottom: 40,
  className: "plot",
  ariaLabel: label,
});

function motion_chart({ motion, rigid_motion }, { deployed_s }, end_s) {
  return {
    draw: (width) =>
      plot_with_room({
        ...frame(width, "pilot angle against time, for elastic and rigid panels"),
        x: time_axis(end_s),
        y: { label: "pilot angle (°)", labelArrow: "none", grid: true, nice: true },
        marks: [
          Plot.ruleY([0], { stroke: "var(--ink-soft)" }),
          Plot.line(rigid_motion, {
            stroke: "var(--ink-soft)",
            strokeWidth: 2,
            strokeDasharray: "6 4",
          }),
          Plot.line(motion, { stroke: "var(--accent)", strokeWidth: 2 }),
          ...deployed_marks(deployed_s),
          tip_of(motion, (time, angle) => `${number(time)} s: ${degrees(angle)}`),
        ],
      }),
  };
}

function stress_chart({ history }, { deployed_s, largest }, end_s) {
  const most = largest ? [[largest.time_s, largest.stress_mpa]] : [];
  return {
    draw: (width) =>
      plot_with_room({
        ...frame(width, "largest von Mises stress outside the discs against time"),
        x: time_axis(end_s),
        y: {
          label: "largest stress (MPa)",
          labelArrow: "none",
          grid: true,
          nice: true,
          zero: true,
        },
        marks: [
          Plot.ruleY([0], { stroke: "var(--ink-soft)" }),
          Plot.line(history, { stroke: "var(--accent)", strokeWidth: 2 }),
          Plot.dot(most, { fill: "var(--pick)", stroke: "var(--card)", r: 4.5 }),
          ...deployed_marks(deployed_s),
          tip_of(history, (time, stress) => `${number(time)} s: ${number(stress)} MPa`),
        ],
      }),
  };
}

const rows_of = (heads, points) => ({
  heads,
  rows: points.map((point) => point.map(single)),
});

function save_charts(report, detail, { motion, history }) {
  const stem = file_stem(report, detail.draw),
    plot_of = (id) => () => by_id(id).querySelector("svg.plot");
  add_saving(by_id("stress-motion").closest("figure"), {
    name: `${stem}-elastic-motion`,
    csv: () => rows_of(["time_s", "pilot_deg"], motion),
    svg: plot_of("stress-motion"),
  });
  add_saving(by_id("stress-history").closest("figure"), {
    name: `${stem}-stress`,
    csv: () => rows_of(["time_s", "outside_discs_mpa"], history),
    svg: plot_of("stress-history"),
  });
}

/** Charts with their boxes; none, and hidden cards, where the report has no stresses. */
export function make_stress(report, detail, decoded) {
  const { stress } = detail;
  for (const id of ["stress-card", "stress-motion-card", "stress-history-card"])
    by_id(id).hidden = !stress;
  recolour_panels = () => {};
  if (!stress) return [];
  show_facts(detail, decoded);
  recolour_panels = show_panels(report.sheet, stress.panels_mpa);
  save_charts(report, detail, decoded.stress);
  const end_s = decoded.stress.motion.at(-1)[0];
  return [
    {
      box: by_id("stress-motion"),
      chart: motion_chart(
        decoded.stress,
        stress,
        Math.max(end_s, decoded.stress.rigid_motion.at(-1)?.[0] ?? 0),
      ),
    },
    { box: by_id("stress-history"), chart: stress_chart(decoded.stress, stress, end_s) },
  ];
}
