// Compares the page's campaign with another: key figures, survival, first faults, and D of
// candidates.
import * as Plot from "@observablehq/plot";
import { fault_legend, first_faults_csv, survival_csv } from "./acceptance.js";
import { at_least } from "./angles.js";
import { log_chart, show_when_wide } from "./chart.js";
import { fault_bins, faults_chart, survival_chart, survival_of } from "./faults.js";
import {
  by_id,
  compared,
  count,
  degrees,
  h,
  legend_entry,
  number,
  percent,
  plural,
  powers,
} from "./format.js";
import { add_saving_once, single } from "./save.js";
import { difference_of, sum } from "./shares.js";

const kColours = ["var(--first)", "var(--second)"];
const kMostKeys = 14,
  kMostLetters = 36; // of a configuration's value

/** Names of two campaigns by the first of these that tells them apart. */
function names_of(both) {
  const ways = [
    ({ campaign }) => campaign.name,
    ({ campaign }) => `${campaign.name} (${campaign.identity.slice(0, 8)})`,
    ({ catalogue }) => catalogue,
    ({ campaign }, k) => `${campaign.name}, ${["first", "second"][k]}`,
  ];
  return ways.map((name) => both.map(name)).find(([first, second]) => first !== second);
}

const is_same = (both, value) => {
  const [first, second] = both.map((side) => JSON.stringify(value(side.campaign.configuration)));
  return first === second;
};
const criterion = ({ accept, path, target }) => [accept, path, target];
const makes_draws = ({ pattern, misalignment, seed }) => [pattern, misalignment, seed];

/** The words about the difference of the acceptance rates, and whether it is resolved. */
function difference_words(both, names) {
  const rates = both.map(({ state }) => state.acceptance ?? {}),
    thresholds = both.map((side) => side.campaign.configuration.accept.deploys_from_deg);
  if (both.some(({ state }) => !state.draws))
    return { words: "One of the campaigns has no draw yet.", is_resolved: false };
  const { difference, low, high } = difference_of(...rates),
    is_resolved = low > 0 || high < 0,
    points = (share) => number(100 * share);
  const larger = difference > 0 ? 0 : 1,
    [more, less] = [rates[larger].rate, rates[1 - larger].rate];
  const ratio =
    less > 0 && more > less ? ` ${names[larger]} has ${number(more / less)} times the rate.` : "";
  const words = [
    `Difference of the acceptance rates, ${names[0]} less ${names[1]}: ${points(difference)} percentage points, 95 % interval ${points(low)} to ${points(high)}.${ratio}`,
    `The interval ${is_resolved ? "excludes" : "includes"} 0: the difference is ${is_resolved ? "" : "not "}larger than the intervals of the two rates allow (Newcombe’s square-and-add rule, for independent samples).`,
    thresholds[0] === thresholds[1]
      ? ""
      : `The thresholds differ, ${thresholds.map(degrees).join(" and ")}: the rates are of different requirements.`,
    is_same(both, makes_draws)
      ? "Both campaigns make the same draws, from one seed: their rates are not independent."
      : "",
  ];
  return { words: words.filter(Boolean).join(" "), is_resolved };
}

/** A configuration as [["accept.deploys_from_deg", 170]…]. */
const leaves = (value, name = "") =>
  value !== null && typeof value === "object" && !Array.isArray(value)
    ? Object.entries(value).flatMap(([key, inner]) => leaves(inner, name ? `${name}.${key}` : key))
    : [[name, value]];

/** The keys of the configurations that differ: [[name, [first, second]]…]. */
function differing_keys(both) {
  const [first, second] = both.map((side) => new Map(leaves(side.campaign.configuration)));
  const text = (value) => {
    const words = value === undefined ? "–" : JSON.stringify(value);
    return words.length > kMostLetters ? `${words.slice(0, kMostLetters)}…` : words;
  };
  return [...new Set([...first.keys(), ...second.keys()])]
    .filter(
      (key) => key !== "name" && JSON.stringify(first.get(key)) !== JSON.stringify(second.get(key)),
    )
    .map((key) => [key, [first, second].map((values) => text(values.get(key)))]);
}

/** The lowest pilot angle at which half of the sampled draws, or fewer, are without a fault. */
const median_deg = (side) =>
  survival_of(side).points.find(({ share }) => share <= 0.5)?.angle ?? null;

/** Rows of key figures: [label, [first, second], which is better: 0, 1 or null]. */
function figure_rows(both, is_resolved) {
  const best = both.map(({ angles }) => angles.at(-1)?.[0] ?? null),
    rates = both.map(({ state }) => state.acceptance?.rate ?? null);
  const larger = ([a, b], counts) => (counts && a !== b ? (a > b ? 0 : 1) : null);
  const of_each = (value) => both.map(({ state }) => value(state));
  return [
    ["Threshold", both.map((s) => degrees(s.campaign.configuration.accept.deploys_from_deg)), null],
    ["Draws", of_each(({ draws }) => count(draws)), null],
    ["Accepted", of_each(({ accepted }) => count(accepted)), null],
    ["Undecided", of_each(({ undecided }) => count(undecided)), null],
    [
      "Acceptance rate",
      rates.map((rate) => percent(rate)),
      larger(rates, is_resolved && is_same(both, criterion)),
    ],
    [
      "95 % interval",
      of_each(({ draws, acceptance }) =>
        draws ? `${percent(acceptance.rate_low)} – ${percent(acceptance.rate_high)}` : "–",
      ),
      null,
    ],
    ["One in", rates.map((rate) => (rate > 0 ? count(Math.round(1 / rate)) : "–")), null],
    ["Fault sample (draws)", both.map(({ faults }) => count(sum(faults.rows))), null],
    [
      "Median pilot angle of the first fault",
      both.map((side) => (side.faults.rows.length ? degrees(median_deg(side)) : "–")),
      null,
    ],
    [
      "Best D",
      best.map(degrees),
      larger(
        best.map((deg) => deg ?? -1),
        true,
      ),
    ],
    [
      "Draws per second, last run",
      of_each(({ draws_per_s }) => count(Math.round(draws_per_s))),
      null,
    ],
  ];
}

function figures_table(both, names, is_resolved) {
  const line = (label, values, better) =>
    h(
      "tr",
      {},
      h("th", { scope: "row" }, label),
      values.map((value, k) => compared(value, k === better)),
    );
  const keys = differing_keys(both),
    shown = keys.slice(0, kMostKeys);
  const head = (text, k) =>
    h("th", { scope: "col" }, h("i", { style: `background: ${kColours[k]}` }), text);
  return h(
    "table",
    { class: "beside" },
    h("thead", {}, h("tr", {}, h("th", { scope: "col" }, ""), names.map(head))),
    h(
      "tbody",
      {},
      figure_rows(both, is_resolved).map((row) => line(...row)),
    ),
    h(
      "tbody",
      { class: "keys" },
      h(
        "tr",
        {},
        h(
          "th",
          { scope: "colgroup", colspan: 3 },
          keys.length
            ? `Configuration: ${plural(keys.length, "key")} with different values` +
                (keys.length > shown.length ? `, the first ${shown.length}` : "")
            : "Configuration: no key with different values",
        ),
      ),
      shown.map(([key, values]) => line(h("code", {}, key), values, null)),
    ),
  );
}

/** Candidates per draw by D: [{ angle, beyond, share }…], from the threshold on. */
function reach_points({ angles, state, campaign }) {
  const points = at_least(angles);
  if (points.length === 0) return [];
  const from_deg = campaign.configuration.accept.deploys_from_deg;
  return [{ angle: from_deg, beyond: points[0].beyond }, ...points].map((point) => ({
    ...point,
    share: point.beyond / state.draws_in_ledger,
  }));
}

function reach_chart(sides, names, width) {
  const all = sides.flatMap((points, k) => points.map((point) => ({ ...point, k })));
  const least = 10 ** Math.floor(Math.log10(0.7 * Math.min(...all.map(({ share }) => share)))),
    most = 10 ** Math.ceil(Math.log10(Math.max(...all.map(({ share }) => share))) - 1e-9),
    first_deg = Math.min(...all.map(({ angle }) => angle));
  const along = { x: "angle", y: "share", curve: "step-before" };
  return log_chart({
    ...{ width, height: 280, marginRight: 24 },
    ariaLabel: "Candidates per draw by the angle from which they deploy",
    x: {
      label: "pilot angle (°)",
      domain: [first_deg, Math.max(first_deg + 1, ...all.map(({ angle }) => angle))],
    },
    y: {
      label: "candidates per draw (%, log scale)",
      domain: [least, Math.max(most, 10 * least)],
      ...{ ticks: powers(least, most), tickFormat: (share) => percent(share, 1) },
    },
    marks: [
      ...sides.flatMap((points, k) => [
        Plot.lineY(points, { ...along, stroke: kColours[k], strokeWidth: 2 }),
        Plot.dot(points.slice(-1), { x: "angle", y: "share", fill: kColours[k], r: 4 }),
      ]),
      Plot.tip(
        all,
        Plot.pointer({
          ...{ x: "angle", y: "share" },
          title: ({ angle, beyond, share, k }) =>
            `${names[k]}, ${degrees(angle)} or more: ${plural(beyond, "candidate")}\n${percent(share)} of the draws`,
        }),
      ),
    ],
  });
}

const show_card = (box, is_shown, draw, csv, name) => {
  box.closest("figure").hidden = !is_shown;
  if (!is_shown) return;
  show_when_wide(box, draw);
  add_saving_once(box, name, csv);
};

/** Histograms of both, of one scale and with bins of one width. */
function show_first_faults(both, names, stem) {
  const configurations = both.map((side) => side.campaign.configuration),
    path = {
      sample_deg: Math.max(...configurations.map((c) => c.path.sample_deg)),
      end_deg: Math.max(...configurations.map((c) => c.path.end_deg)),
    };
  const tops = new Map();
  both.forEach(({ faults }, k) => {
    for (const { to, share } of fault_bins(faults.rows, { path }))
      tops.set(`${k} ${to}`, (tops.get(`${k} ${to}`) ?? 0) + share);
  });
  const most = Math.max(...tops.values());
  both.forEach((side, k) => {
    const { rows } = side.faults,
      box = by_id(`faults-${k}`);
    by_id(`faults-${k}-caption`).replaceChildren(
      `${names[k]}: ${plural(sum(rows), "sampled draw")}.`,
      fault_legend(rows),
    );
    show_card(
      box,
      tops.size > 0 && rows.length > 0,
      (width) =>
        faults_chart(rows, sum(rows), { path, accept: configurations[k].accept }, width, most),
      () => first_faults_csv(side),
      `${stem}-first-faults-${k + 1}`,
    );
  });
}

function show_survival(both, names, stem) {
  const samples = both.map((side, k) => ({
    ...survival_of(side),
    ...{ name: names[k], colour: kColours[k], colour_of_marks: kColours[k] },
  }));
  show_card(
    by_id("survivals"),
    both.every(({ faults }) => faults.rows.length > 0),
    (width) => survival_chart(samples, width),
    () => survival_csv(samples),
    `${stem}-survival`,
  );
}

function show_reach(both, names, stem) {
  const sides = both.map(reach_points);
  show_card(
    by_id("reach"),
    sides.some((points) => points.length > 0),
    (width) => reach_chart(sides, names, width),
    () => ({
      heads: ["campaign", "deploys_from_deg", "candidates_from_there_on", "share_of_draws"],
      rows: sides.flatMap((points, k) =>
        points.slice(1).map(({ angle, beyond, share }) => [names[k], angle, beyond, single(share)]),
      ),
    }),
    `${stem}-angles`,
  );
}

/** Shows the comparison on the page of a report with another campaign. */
export function show_two_campaigns(report) {
  if (!report.beside) return;
  const both = [report, report.beside],
    names = names_of(both),
    stem = `${report.campaign.name}-and-${report.beside.campaign.name}`;
  by_id("two-campaigns").hidden = false;
  const { words, is_resolved } = difference_words(both, names);
  by_id("two-campaigns-words").textContent = words;
  for (const legend of document.querySelectorAll("#two-campaigns .sides"))
    legend.replaceChildren(...names.map((name, k) => legend_entry(kColours[k], name)));
  by_id("two-campaigns-table").replaceChildren(figures_table(both, names, is_resolved));
  show_survival(both, names, stem);
  show_first_faults(both, names, stem);
  show_reach(both, names, stem);
}
