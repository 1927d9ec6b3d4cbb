// Shows the overview of a plain search: its acceptance, and charts of the first faults.
import { show_when_wide } from "./chart.js";
import { fault_map, kMostBars, parts_of, places, where_chart } from "./fault_places.js";
import { fault_bins, faults_chart, survival_chart, survival_of } from "./faults.js";
import { beyond_tiles, how_far, live_tiles, show_tiles, shown_tiles, tile } from "./figures.js";
import { by_id, count, degrees, h, legend_entry, percent, plural } from "./format.js";
import { make_passage } from "./passage.js";
import { add_saving_once, single } from "./save.js";
import { effective, sum } from "./shares.js";
import { fault_colour, fault_name, fault_words, faults_in } from "./words.js";

function show_figures(report) {
  const { state, campaign, candidates } = report;
  const { rate, rate_low, rate_high } = state.acceptance ?? {};
  const known = rate !== null && rate !== undefined;
  show_tiles([
    tile(
      "Draws",
      count(state.draws),
      how_far(state.complete, state.draws, state.without_end ? null : state.missing),
    ),
    tile(
      "Accepted",
      count(state.accepted),
      `deploy from ${degrees(campaign.configuration.accept.deploys_from_deg)} or more`,
    ),
    tile(
      "Acceptance rate",
      known ? percent(rate) : "–",
      known ? `95 %: ${percent(rate_low)} – ${percent(rate_high)}` : "no draw yet",
      "Accepted draws per draw, with the 95 % interval of a binomial share",
    ),
    tile(
      "One in",
      rate > 0 ? count(Math.round(1 / rate)) : "–",
      rate > 0 ? "draws is accepted" : "no draw accepted yet",
    ),
    tile("Undecided", count(state.undecided), "numerical failures, counted separately"),
    ...beyond_tiles(
      state.draws_in_ledger - state.draws,
      "draws in table and charts, but not in the figures above",
    ),
    ...live_tiles(report),
    ...shown_tiles(candidates),
  ]);
}

/** The names and colours of the faults of rows. */
export const fault_legend = (rows) =>
  h(
    "ul",
    { class: "legend" },
    faults_in(rows.map((row) => row.first_fault))
      .filter((fault) => fault !== "none")
      .map((fault) => legend_entry(fault_colour(fault), fault_name(fault), fault_words(fault))),
  );

export function first_faults_csv({ faults, campaign }) {
  return {
    heads: ["first_fault", "above_deg", "up_to_deg", "sampled", "share"],
    rows: fault_bins(faults.rows, campaign.configuration).map((bin) => [
      ...[bin.first_fault, bin.from, bin.to, bin.sampled],
      single(bin.share),
    ]),
  };
}

/** The survival of samples, as survival_of returns them; with several, each row names its one. */
export const survival_csv = (samples) => ({
  heads: [
    ...(samples.length > 1 ? ["campaign"] : []),
    ...["pilot_deg", "share_without_fault", "low_95", "high_95"],
  ],
  rows: samples.flatMap(({ points, name }) =>
    points.map(({ angle, share, low, high }) => [
      ...(samples.length > 1 ? [name] : []),
      ...[angle, ...[share, low, high].map(single)],
    ]),
  ),
});

function places_csv({ faults, sheet }) {
  return {
    heads: ["where", "first_fault", "sampled", "share"],
    rows: parts_of(places(faults.rows, sheet).list).map(
      ({ where, first_fault, sampled, share }) => [where, first_fault, sampled, single(share)],
    ),
  };
}

/** The two charts along the folding. */
function show_along_the_folding(report, total) {
  const { rows } = report.faults,
    { name, configuration } = report.campaign;
  const none = sum(rows.filter((row) => row.first_fault === "none"));
  const nowhere = sum(rows.filter((row) => row.first_fault !== "none" && row.fault_deg === null));
  by_id("faults-caption").replaceChildren(
    `No fault up to ${degrees(configuration.path.end_deg)}: ${plural(none, "sampled draw")}.` +
      (nowhere ? ` Fault without an angle: ${plural(nowhere, "sampled draw")}.` : ""),
    fault_legend(rows),
  );
  const survival = survival_of(report);
  const passage = make_passage(report, (width) => faults_chart(rows, total, configuration, width));
  show_when_wide(by_id("faults"), passage.draw);
  passage.show();
  show_when_wide(by_id("survival"), (width) => survival_chart([survival], width));
  add_saving_once(by_id("faults"), `${name}-first-faults`, () => first_faults_csv(report));
  add_saving_once(by_id("survival"), `${name}-survival`, () => survival_csv([survival_of(report)]));
}

/** The charts of first faults by diagonal and crease. */
function show_places(report) {
  const { list, total } = places(report.faults.rows, report.sheet),
    { name } = report.campaign;
  for (const id of ["where", "map"]) by_id(id).closest("figure").hidden = list.length === 0;
  if (list.length === 0) return;
  by_id("where-caption").replaceChildren(
    `${plural(total, "sampled draw")} failed at one diagonal or crease` +
      (list.length > kMostBars
        ? `; the ${kMostBars} most frequent of ${list.length} places.`
        : "."),
    fault_legend(parts_of(list)),
  );
  show_when_wide(by_id("where"), (width) => where_chart(list, width));
  if (!by_id("map").matches(":hover")) by_id("map").replaceChildren(fault_map(list, report));
  add_saving_once(by_id("where"), `${name}-places`, () => places_csv(report));
  add_saving_once(by_id("map"), `${name}-map`, () => places_csv(report));
}

/** Shows figures and charts; called again whenever the report has changed. */
export function show_acceptance(report) {
  const { faults } = report,
    total = sum(faults.rows),
    note = by_id("sample-note");
  show_figures(report);
  by_id("acceptance-charts").hidden = total === 0;
  if (total === 0) {
    note.textContent = `The fault sample is empty so far: it takes one draw in ${count(faults.every)}.`;
    return;
  }
  note.textContent =
    `Exact first faults of an unbiased sample: one draw in ${count(faults.every)} (${plural(total, "draw")})` +
    (faults.every_at_most > faults.every
      ? `, later up to one in ${count(faults.every_at_most)}, weighted by the draws that each represents. Effective sample size: ${plural(Math.round(effective(faults.rows)), "draw")}. `
      : ". ") +
    "All other draws are rejected at the first proof against them, which need not be at their first fault.";
  show_along_the_folding(report, total);
  show_places(report);
}
