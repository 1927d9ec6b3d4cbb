// The overview: the campaign in words, its acceptance, and the charts of where draws fail.
import { count, degrees, h, number, percent, plural } from "./format.js";
import { show_when_wide } from "./chart.js";
import { fault_map, kMostBars, places, where_chart } from "./fault_places.js";
import { fault_bins, faults_chart, survival_chart } from "./faults.js";
import { add_saving, single } from "./save.js";
import { effective, sum, survival_points } from "./shares.js";
import { fault_colour, fault_name, fault_order, fault_words } from "./words.js";

const values_of = (value) => (Array.isArray(value) ? value.join(", ") : String(value));

/** What the campaign asked, in words. */
function asked(configuration, actuators) {
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
        ? plural(pattern.holes.length, "hole")
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
  const exactly = accept.between_samples === "exact" ? "exactly " : "";
  return (
    `${sheet}; ${holes}. Each draw shifts x and y of ${which} by ${levels}. A draw is accepted when every diagonal ` +
    `of every hole only grows or only shrinks from flat to a pilot fold angle of ${degrees(accept.deploys_from_deg)} or more` +
    `${accept.between_samples ? `, ${exactly}between the samples too` : ""}${stop_words(accept, actuators)} (samples every ${degrees(path.sample_deg)} up to ${degrees(path.end_deg)}).`
  );
}

function stop_words({ stops_at_deg, stop_stiffness_mm2_per_rad2 }, { stiffness_n_per_mm }) {
  if (!stops_at_deg) return "";
  return (
    `, and springs of ${number(stiffness_n_per_mm)} N/mm that are relaxed at ${degrees(stops_at_deg)} hold it there ` +
    `with at least ${number(stop_stiffness_mm2_per_rad2 * stiffness_n_per_mm)} N mm/rad`
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
  if (state.draws_in_ledger > state.draws)
    box.append(
      tile(
        "Beyond the goal",
        count(state.draws_in_ledger - state.draws),
        "draws that the figures before do not count, but table and charts do",
      ),
    );
  if (candidates.shown < candidates.total)
    box.append(
      tile(
        "In this report",
        count(candidates.shown),
        `best of ${plural(candidates.total, "candidate")}`,
      ),
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

export function show_acceptance(report) {
  const { campaign, faults } = report,
    total = sum(faults.rows),
    note = document.getElementById("sample-note");
  document.title = `${campaign.name} · misalign report`;
  document.getElementById("campaign-name").textContent = campaign.name;
  document.getElementById("asked").textContent = asked(campaign.configuration, report.actuators);
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
