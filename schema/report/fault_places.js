// Charts the first faults by diagonal and crease, as bars and on the sheet.
import * as Plot from "@observablehq/plot";
import { plot_of } from "./chart.js";
import { ends_of } from "./data.js";
import { dashed, h, percent, plural } from "./format.js";
import { line, panel_size_mm, polygon, sheet_svg } from "./sheet.js";
import { sum, weight } from "./shares.js";
import { fault_colour, fault_name, faults_in } from "./words.js";

/** Returns whether a text names two vertices of the sheet: a catalogue may hold any text. */
const is_place = (where, { vertices_mm }) =>
  /^A\d+-A\d+$/.test(where) && ends_of(where).every((vertex) => vertices_mm[vertex]);

export function places(rows, sheet) {
  const shares = new Map();
  const named = rows.filter(
    (row) => row.where && row.first_fault !== "none" && is_place(row.where, sheet),
  );
  const all = sum(named, weight);
  for (const row of named) {
    const { where, first_fault, sampled } = row;
    if (!shares.has(where)) shares.set(where, { where, sampled: 0, share: 0, faults: new Map() });
    const entry = shares.get(where),
      part = entry.faults.get(first_fault) ?? { sampled: 0, share: 0 };
    for (const counted of [entry, part]) {
      counted.sampled += sampled;
      counted.share += weight(row) / all;
    }
    entry.faults.set(first_fault, part);
  }
  const list = [...shares.values()].sort((a, b) => b.share - a.share);
  return { list, total: sum(named) };
}

/** The faults of each place: [{ where, first_fault, sampled, share }…]. */
export const parts_of = (list) =>
  list.flatMap(({ where, faults }) =>
    [...faults].map(([first_fault, part]) => ({ where, first_fault, ...part })),
  );

export const kMostBars = 20;

export function where_chart(list, width) {
  const shown = list.slice(0, kMostBars);
  const parts = parts_of(shown),
    present = faults_in(parts.map((part) => part.first_fault));
  return plot_of({
    width,
    height: 44 + 23 * shown.length,
    marginLeft: 74,
    marginRight: 44,
    marginBottom: 38,
    ariaLabel: "Shares of the first faults by diagonal or crease",
    x: {
      label: "share of located first faults (%)",
      percent: true,
      grid: true,
    },
    y: { label: null, domain: shown.map((entry) => entry.where), tickFormat: dashed, tickSize: 0 },
    color: { domain: present, range: present.map(fault_colour) },
    marks: [
      Plot.barX(
        parts,
        Plot.stackX({
          y: "where",
          x: "share",
          fill: "first_fault",
          order: present,
          insetTop: 1,
          insetBottom: 1,
          title: (d) =>
            `${dashed(d.where)}: ${fault_name(d.first_fault)}\n${plural(d.sampled, "sampled draw")} (${percent(d.share)})`,
          tip: true,
        }),
      ),
      Plot.text(shown, {
        y: "where",
        x: "share",
        text: (d) => percent(d.share, 2),
        textAnchor: "start",
        dx: 5,
        fill: "var(--ink-soft)",
      }),
    ],
  });
}

export function fault_map(list, report) {
  const { sheet, diagonals } = report,
    size = panel_size_mm(sheet);
  const svg = sheet_svg(
    sheet.vertices_mm,
    0.25 * size,
    "Map of the sheet: diagonals and creases coloured by their share of the first faults",
  );
  const shares = new Map(list.map((entry) => [entry.where, entry]));
  const most = list[0]?.share ?? 1;
  for (const panel of sheet.panels)
    svg.append(polygon(panel, sheet.vertices_mm, { class: "map-panel" }));
  for (const { a, b } of sheet.creases)
    svg.append(line(sheet.vertices_mm[a], sheet.vertices_mm[b], { class: "map-crease" }));
  const draw = (name) => {
    const entry = shares.get(name),
      [a, b] = ends_of(name),
      part = (entry?.share ?? 0) / most;
    const stroke = line(sheet.vertices_mm[a], sheet.vertices_mm[b], {
      class: "map-place",
      "data-where": name,
      style: `stroke: color-mix(in oklab, var(--heat-most) ${(100 * part).toFixed(1)}%, var(--heat-least)); stroke-width: ${(size * (0.03 + 0.06 * part)).toFixed(2)}`,
    });
    stroke.append(
      h(
        "svg:title",
        {},
        `${dashed(name)}: ${entry ? `${percent(entry.share)} (${plural(entry.sampled, "sampled draw")})` : "no first fault in the sample"}`,
      ),
    );
    svg.append(stroke);
  };
  const of_diagonals = new Set(diagonals.map((d) => `${d.from}-${d.to}`));
  for (const { where } of [...list].reverse()) if (!of_diagonals.has(where)) draw(where);
  // The least first, so that the most stays on top where diagonals cross.
  [...of_diagonals]
    .sort((a, b) => (shares.get(a)?.share ?? 0) - (shares.get(b)?.share ?? 0))
    .forEach(draw);
  return h(
    "div",
    {},
    svg,
    h("div", { class: "scale" }, h("span", {}, "0 %"), h("i", {}), h("span", {}, percent(most, 2))),
  );
}
