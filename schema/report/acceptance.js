// The overview of a plain search: its acceptance, and the charts of where draws fail.
import { show_when_wide } from "./chart.js";
import { fault_map, kMostBars, places, where_chart } from "./fault_places.js";
import { fault_bins, faults_chart, survival_chart } from "./faults.js";
import { beyond_tiles, how_far, shown_tiles, tile } from "./figures.js";
import { count, degrees, h, percent, plural } from "./format.js";
import { add_saving, single } from "./save.js";
import { effective, sum, survival_points } from "./shares.js";
import { fault_colour, fault_name, fault_order, fault_words } from "./words.js";

function show_figures({ state, campaign, candidates }) {
  const { rate, rate_low, rate_high } = state.acceptance ?? {};
  const known = rate !== null && rate !== undefined;
  const box = document.getElementById("figures");
  box.append(
    tile("Draws", count(state.draws), how_far(state.complete, state.missing)),
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
    ...beyond_tiles(
      state.draws_in_ledger - state.draws,
      "draws that the figures before do not count, but table and charts do",
    ),
    ...shown_tiles(candidates),
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
        h("i", { style: `background: ${fault_colour(fault)}` }),
        fault_name(fault),
      ),
    ),
  );
}

/** The two charts along the folding. */
function show_along_the_folding(report, total, name) {
  const { rows } = report.faults,
    { configuration } = report.campaign,
    box_of = (id) => document.getElementById(id);
  const none = sum(rows.filter((row) => row.first_fault === "none"));
  const nowhere = sum(rows.filter((row) => row.first_fault !== "none" && row.fault_deg === null));
  const present = fault_order.filter(
    (fault) => fault !== "none" && rows.some((row) => row.first_fault === fault),
  );
  box_of("faults-caption").append(
    `Without any fault to ${degrees(configuration.path.end_deg)}: ${plural(none, "sampled draw")}.` +
      (nowhere ? ` Without an angle: ${plural(nowhere, "sampled draw")}.` : ""),
    legend(present),
  );
  const points = survival_points(rows, configuration);
  show_when_wide(box_of("faults"), (width) => faults_chart(rows, total, configuration, width));
  show_when_wide(box_of("survival"), (width) => survival_chart(points, total, report, width));
  save_chart("faults", `${name}-first-faults`, () => ({
    heads: ["first_fault", "above_deg", "up_to_deg", "sampled", "share"],
    rows: fault_bins(rows, configuration).map((bin) => [
      ...[bin.first_fault, bin.from, bin.to, bin.sampled],
      single(bin.share),
    ]),
  }));
  save_chart("survival", `${name}-survival`, () => ({
    heads: ["pilot_deg", "share_without_fault", "low_95", "high_95"],
    rows: points.map(({ angle, share, low, high }) => [angle, ...[share, low, high].map(single)]),
  }));
}

/** The same faults by the diagonal or crease that shows them. */
function show_places(report, name) {
  const { list, total } = places(report.faults.rows, report.sheet),
    box_of = (id) => document.getElementById(id);
  if (list.length === 0) {
    for (const id of ["where", "map"]) box_of(id).closest("figure").hidden = true;
    return;
  }
  box_of("where-caption").append(
    `${plural(total, "sampled draw")} failed at one diagonal or crease` +
      (list.length > kMostBars ? `; the ${kMostBars} commonest of ${list.length} places.` : "."),
    legend(fault_order.filter((fault) => list.some((entry) => entry.faults.has(fault)))),
  );
  show_when_wide(box_of("where"), (width) => where_chart(list, width));
  box_of("map").append(fault_map(list, report));
  const rows = () => ({
    heads: ["where", "first_fault", "sampled", "share"],
    rows: list.flatMap(({ where, faults }) =>
      [...faults].map(([fault, { sampled, share }]) => [where, fault, sampled, single(share)]),
    ),
  });
  save_chart("where", `${name}-places`, rows);
  save_chart("map", `${name}-map`, rows);
}

function save_chart(id, name, csv) {
  const box = document.getElementById(id);
  add_saving(box.closest(".card"), { name, csv, svg: () => box.querySelector("svg") });
}

/** Figures and charts. */
export function show_acceptance(report) {
  const { campaign, faults } = report,
    total = sum(faults.rows),
    note = document.getElementById("sample-note");
  show_figures(report);
  if (total === 0) {
    note.textContent = `First faults are known exactly for one draw in ${count(faults.every)}; there is none in this catalogue yet.`;
    document.getElementById("acceptance-charts").hidden = true;
    return;
  }
  note.textContent =
    `From an unbiased sample: of one draw in ${count(faults.every)} (${plural(total, "draw")}) the exact first fault is known` +
    (faults.every_at_most > faults.every
      ? `; of later ones up to one in ${count(faults.every_at_most)}, each weighed by the draws that it stands for: shares are known as well as from ${plural(Math.round(effective(faults.rows)), "draw")} of one weight. `
      : ". ") +
    "All other draws are rejected at whatever angle first shows anything certain against them, which says nothing about where they fail first.";
  show_along_the_folding(report, total, campaign.name);
  show_places(report, campaign.name);
}
