// What was asked, what came out of it, and where along the folding and on the sheet draws fail.
import * as Plot from "@observablehq/plot";
import { ends_of } from "./data.js";
import {
  count,
  dashed,
  degrees,
  fault_name,
  fault_order,
  fault_words,
  h,
  percent,
  plural,
  powers,
} from "./format.js";
import { line, panel_size_mm, polygon, sheet_svg } from "./sheet.js";
import { when_wide } from "./chart.js";

const values_of = (value) => (Array.isArray(value) ? value.join(", ") : String(value));

/** What the campaign asked, in words. */
function asked(configuration) {
  const { pattern, misalignment, path, accept } = configuration;
  const sheet =
    pattern.family === "miura"
      ? `${pattern.rows} × ${pattern.columns} Miura-ori (panels ${values_of(pattern.panel_width_mm)} × ${values_of(pattern.panel_height_mm)} mm, ` +
        `zigzag offset ${values_of(pattern.zigzag_offset_mm)} mm)`
      : `quadrilateral mesh${pattern.file ? ` of ${pattern.file}` : ""}`;
  const holes =
    typeof pattern.holes === "string"
      ? `holes: ${pattern.holes}`
      : Array.isArray(pattern.holes)
        ? `${pattern.holes.length} holes`
        : "with holes";
  const which =
    misalignment.vertices === "interior"
      ? "all interior vertices"
      : misalignment.vertices === "ring"
        ? "the outer ring of interior vertices"
        : plural(misalignment.vertices.length, "vertex", "vertices");
  const levels =
    misalignment.levels === "ternary"
      ? `−${misalignment.amplitude_mm}, 0 or +${misalignment.amplitude_mm} mm`
      : `${misalignment.levels} up to ±${misalignment.amplitude_mm} mm`;
  return (
    `${sheet}; ${holes}. Each draw shifts x and y of ${which} by ${levels}. A draw is accepted when every diagonal ` +
    `of every hole only grows or only shrinks from flat to a pilot fold angle of ${degrees(accept.deploys_from_deg)} or more` +
    `${accept.between_samples ? ", between the samples too" : ""} (samples every ${degrees(path.sample_deg)} up to ${degrees(path.end_deg)}).`
  );
}

function tile(term, value, more, title) {
  return h(
    "div",
    { title },
    h("dt", {}, term),
    h("dd", {}, h("strong", {}, value), more ? h("span", { class: "note" }, more) : null),
  );
}

function show_figures({ state, campaign, candidates }) {
  const { rate, rate_low, rate_high } = state.acceptance ?? {};
  const known = rate !== null && rate !== undefined;
  const box = document.getElementById("figures");
  const done = state.complete
    ? "complete"
    : state.missing
      ? `${count(state.missing)} of those asked for are missing`
      : "the campaign may go on";
  box.append(
    tile("Draws", count(state.draws), done),
    tile(
      "Accepted",
      count(state.accepted),
      `deploy from ${degrees(campaign.configuration.accept.deploys_from_deg)} or more`,
    ),
    tile(
      "Acceptance rate",
      known ? percent(rate) : "–",
      known ? `95 %: ${percent(rate_low)} – ${percent(rate_high)}` : "nothing drawn yet",
      "Accepted draws per draw, with the 95 % interval of a binomial share",
    ),
    tile(
      "One in",
      rate > 0 ? count(Math.round(1 / rate)) : "–",
      rate > 0 ? "draws is accepted" : "no draw accepted yet",
    ),
    tile("Undecided", count(state.undecided), "numerical failures, counted apart"),
  );
  if (candidates.shown < candidates.total)
    box.append(
      tile(
        "In this report",
        count(candidates.shown),
        `best of ${count(candidates.total)} candidates`,
      ),
    );
}

function sum(rows, value = (row) => row.draws) {
  return rows.reduce((total, row) => total + value(row), 0);
}

/** Wilson's 95 % interval of k in n. */
function interval(k, n) {
  const z = 1.96,
    p = k / n,
    middle = (p + (z * z) / (2 * n)) / (1 + (z * z) / n);
  const half = (z / (1 + (z * z) / n)) * Math.sqrt((p * (1 - p)) / n + (z * z) / (4 * n * n));
  return [Math.max(0, middle - half), Math.min(1, middle + half)];
}

function faults_chart(rows, total, { path, accept }, width) {
  const bin_deg = Math.max(5, path.sample_deg);
  const bins = new Map();
  for (const { first_fault, fault_deg, draws } of rows) {
    if (fault_deg === null || first_fault === "none") continue;
    // A bin holds (from, to]: faults at 170° belong to those that fail up to 170°.
    const to = Math.ceil(fault_deg / bin_deg) * bin_deg,
      key = `${first_fault} ${to}`;
    if (!bins.has(key)) bins.set(key, { first_fault, from: to - bin_deg, to, draws: 0 });
    bins.get(key).draws += draws;
  }
  const present = fault_order.filter((fault) =>
    [...bins.values()].some((bin) => bin.first_fault === fault),
  );
  return Plot.plot({
    width,
    height: 280,
    marginLeft: 52,
    marginBottom: 42,
    className: "plot",
    ariaLabel: "First faults along the folding, stacked by kind",
    x: {
      label: "pilot fold angle of the first fault (deg)",
      domain: [0, path.end_deg],
      labelAnchor: "center",
      labelArrow: "none",
    },
    y: { label: "sampled draws (%)", grid: true, labelArrow: "none", percent: true },
    color: {
      domain: present,
      range: present.map((fault) => `var(--${fault.replaceAll("_", "-")})`),
      legend: false,
    },
    marks: [
      Plot.rectY(
        [...bins.values()].sort(
          (a, b) => present.indexOf(a.first_fault) - present.indexOf(b.first_fault),
        ),
        Plot.stackY({
          x1: "from",
          x2: "to",
          y: (bin) => bin.draws / total,
          fill: "first_fault",
          insetLeft: 0.5,
          insetRight: 0.5,
          order: present,
          title: (bin) =>
            `${fault_name(bin.first_fault)}\nabove ${bin.from}° up to ${bin.to}°\n${count(bin.draws)} of ${count(total)} draws (${percent(bin.draws / total)})`,
          tip: true,
        }),
      ),
      Plot.ruleX([accept.deploys_from_deg], { stroke: "var(--ink)", strokeDasharray: "2 3" }),
      Plot.text([accept.deploys_from_deg], {
        x: (d) => d,
        frameAnchor: "top",
        text: () => "threshold",
        textAnchor: "end",
        dx: -5,
        fill: "var(--ink)",
      }),
      Plot.ruleY([0]),
    ],
  });
}

function survival_chart(rows, total, report, width) {
  const { path, accept } = report.campaign.configuration;
  const failed_at = new Map();
  for (const { first_fault, fault_deg, draws } of rows) {
    if (first_fault === "none") continue;
    const angle = fault_deg ?? 0; // a fault of the whole range: it deploys from nowhere
    failed_at.set(angle, (failed_at.get(angle) ?? 0) + draws);
  }
  let left = total;
  const points = [];
  for (const angle of [...new Set([0, ...failed_at.keys(), path.end_deg])].sort((a, b) => a - b)) {
    left -= failed_at.get(angle) ?? 0;
    const [low, high] = interval(left, total);
    points.push({ angle, share: left / total, left, low: Math.max(low, 0.2 / total), high });
  }
  const { rate, rate_low, rate_high } = report.state.acceptance ?? {};
  const overall =
    rate > 0 ? [{ angle: accept.deploys_from_deg, rate, low: rate_low, high: rate_high }] : [];
  const least = Math.min(0.5 / total, overall[0]?.low || 1);
  return Plot.plot({
    width,
    height: 280,
    marginLeft: 62,
    marginBottom: 42,
    className: "plot",
    ariaLabel: "Survival along the folding",
    x: {
      label: "pilot fold angle (deg)",
      domain: [0, path.end_deg],
      labelAnchor: "center",
      labelArrow: "none",
    },
    y: {
      type: "log",
      label: "share without a fault (log scale)",
      grid: true,
      labelArrow: "none",
      domain: [least, 1],
      clamp: true,
      ticks: powers(least, 1),
      tickFormat: (share) => percent(share, 1),
    },
    marks: [
      Plot.areaY(points, {
        x: "angle",
        y1: "low",
        y2: "high",
        curve: "step-after",
        fill: "var(--accent)",
        fillOpacity: 0.18,
      }),
      Plot.lineY(
        points.filter((point) => point.left > 0),
        { x: "angle", y: "share", curve: "step-after", stroke: "var(--accent)", strokeWidth: 2 },
      ),
      Plot.ruleX([accept.deploys_from_deg], { stroke: "var(--ink)", strokeDasharray: "2 3" }),
      Plot.ruleX(overall, {
        x: "angle",
        y1: "low",
        y2: "high",
        stroke: "var(--ink)",
        strokeWidth: 1.5,
      }),
      Plot.dot(overall, {
        x: "angle",
        y: "rate",
        fill: "var(--ink)",
        r: 4,
        title: (d) => `all draws: ${percent(d.rate)} accepted`,
      }),
      Plot.tip(
        points,
        Plot.pointerX({
          x: "angle",
          y: "share",
          title: (d) =>
            `${degrees(d.angle)}: ${percent(d.share)} without a fault\n${count(d.left)} of ${count(total)} draws`,
        }),
      ),
    ],
  });
}

function places(rows) {
  const shares = new Map();
  const named = rows.filter((row) => row.where && row.first_fault !== "none");
  const total = sum(named);
  for (const { where, first_fault, draws } of named) {
    if (!shares.has(where)) shares.set(where, { where, draws: 0, faults: new Map() });
    const entry = shares.get(where);
    entry.draws += draws;
    entry.faults.set(first_fault, (entry.faults.get(first_fault) ?? 0) + draws);
  }
  const list = [...shares.values()].sort((a, b) => b.draws - a.draws);
  for (const entry of list) entry.share = entry.draws / total;
  return { list, total };
}

const kMostBars = 20;

function where_chart(list, width) {
  const shown = list.slice(0, kMostBars);
  const parts = shown.flatMap(({ where, faults, draws, share }) =>
    [...faults].map(([fault, part]) => ({
      where,
      fault,
      part: (share * part) / draws,
      draws: part,
    })),
  );
  const present = fault_order.filter((fault) => parts.some((part) => part.fault === fault));
  return Plot.plot({
    width,
    height: 44 + 23 * shown.length,
    marginLeft: 74,
    marginRight: 44,
    marginBottom: 38,
    className: "plot",
    ariaLabel: "Shares of the first faults by diagonal or crease",
    x: {
      label: "share of the first faults that have a place (%)",
      percent: true,
      labelAnchor: "center",
      labelArrow: "none",
      grid: true,
    },
    y: { label: null, domain: shown.map((entry) => entry.where), tickFormat: dashed, tickSize: 0 },
    color: {
      domain: present,
      range: present.map((fault) => `var(--${fault.replaceAll("_", "-")})`),
    },
    marks: [
      Plot.barX(
        parts,
        Plot.stackX({
          y: "where",
          x: "part",
          fill: "fault",
          order: present,
          insetTop: 1,
          insetBottom: 1,
          title: (d) =>
            `${dashed(d.where)}: ${fault_name(d.fault)}\n${count(d.draws)} sampled draws (${percent(d.part)})`,
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

function fault_map(list, report) {
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
        `${dashed(name)}: ${entry ? `${percent(entry.share)} (${count(entry.draws)} sampled draws)` : "no first fault in the sample"}`,
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

function legend(faults) {
  return h(
    "ul",
    { class: "legend" },
    faults.map((fault) =>
      h(
        "li",
        { title: fault_words(fault) },
        h("i", { style: `background: var(--${fault.replaceAll("_", "-")})` }),
        fault_name(fault),
      ),
    ),
  );
}

export function show_acceptance(report) {
  const { campaign, faults } = report,
    { configuration } = campaign;
  document.title = `${campaign.name} · misalign report`;
  document.getElementById("campaign-name").textContent = campaign.name;
  document.getElementById("asked").textContent = asked(configuration);
  show_figures(report);

  const total = sum(faults.rows),
    note = document.getElementById("sample-note");
  if (total === 0) {
    note.textContent = `First faults are known exactly for one draw in ${count(faults.every)}; there is none in this catalogue yet.`;
    document.getElementById("acceptance-charts").hidden = true;
    return;
  }
  note.textContent =
    `From an unbiased sample: of one draw in ${count(faults.every)} (${count(total)} draws) the exact first fault is known. ` +
    "All other draws are turned away at whatever angle first shows anything certain against them, which says nothing about where they fail first.";
  const none = sum(faults.rows.filter((row) => row.first_fault === "none"));
  const nowhere = sum(
    faults.rows.filter((row) => row.first_fault !== "none" && row.fault_deg === null),
  );
  const present = fault_order.filter(
    (fault) => fault !== "none" && faults.rows.some((row) => row.first_fault === fault),
  );
  document
    .getElementById("faults-caption")
    .append(
      `Without any fault to ${degrees(configuration.path.end_deg)}: ${plural(none, "draw")}.` +
        (nowhere ? ` Without an angle: ${plural(nowhere, "draw")}.` : ""),
      legend(present),
    );
  when_wide(document.getElementById("faults"), (width) =>
    faults_chart(faults.rows, total, configuration, width),
  );
  when_wide(document.getElementById("survival"), (width) =>
    survival_chart(faults.rows, total, report, width),
  );

  const { list, total: placed } = places(faults.rows);
  if (list.length === 0) {
    for (const id of ["where", "map"]) document.getElementById(id).closest("figure").hidden = true;
    return;
  }
  document
    .getElementById("where-caption")
    .append(
      `${plural(placed, "sampled draw")} failed at one diagonal or crease` +
        (list.length > kMostBars ? `; the ${kMostBars} commonest of ${list.length} places.` : "."),
      legend(fault_order.filter((fault) => list.some((entry) => entry.faults.has(fault)))),
    );
  when_wide(document.getElementById("where"), (width) => where_chart(list, width));
  document.getElementById("map").append(fault_map(list, report));
}
