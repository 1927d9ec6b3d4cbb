// Shows the overview of a splitting search: its figures, and its levels as a chart and a table.
import { show_when_wide } from "./chart.js";
import { beyond_tiles, how_far, live_tiles, show_tiles, shown_tiles, tile } from "./figures.js";
import { by_id, count, degrees, fixed, h, number, percent, table } from "./format.js";
import { ladder_chart } from "./ladder_chart.js";
import { add_saving_once, single } from "./save.js";

const kWaits = "No level is known yet: the level finder has not finished.";

const share_of = (some, all) => (all > 0 ? some / all : null);
const interval_of = ({ rate_low, rate_high }) =>
  rate_low === null ? null : `${number(rate_low)} – ${number(rate_high)}`;

/** Says why there is no interval. */
const no_interval = ({ populations_here }, populations) =>
  populations === 0
    ? "nothing searched yet"
    : populations_here === 0
      ? "no population reached the last level"
      : "no interval from so few populations";

function rate_tiles({ levels, populations }, from) {
  const last = levels.at(-1),
    rate = last?.rate;
  if (!last) return [tile("Share of draws", "–", "no level is known yet")];
  const interval = interval_of(last),
    ancestors = levels.at(-2).ancestors;
  return [
    tile(
      "Share of draws",
      number(rate),
      interval ? `95 %: ${interval}` : no_interval(last, populations),
      `Share of all draws that deploy from ${from} or more: mean of the populations, with its 95 % interval`,
    ),
    tile(
      "One in",
      rate > 0 ? number(1 / rate) : "–",
      rate > 0 ? `draws deploys from ${from}` : "no estimate yet",
    ),
    tile(
      "Ancestors",
      count(ancestors),
      `of ${count(levels[0].tried)} first draws: origin of the sheets at the last level`,
      "Sheets with few ancestors are alike",
    ),
  ];
}

function show_figures(report, ladder) {
  const { state, campaign, candidates } = report;
  const from = degrees(campaign.configuration.accept.deploys_from_deg),
    undecided = ladder.levels.reduce((total, level) => total + level.undecided, 0),
    beyond = (state.draws_in_ledger - state.draws) / ladder.numbers_of_population;
  show_tiles([
    tile(
      "Populations",
      count(ladder.populations),
      how_far(state.complete, ladder.populations, ladder.without_end ? null : ladder.missing),
    ),
    tile("Candidates kept", count(state.accepted), `deploy from ${from} or more, each once`),
    ...rate_tiles(ladder, from),
    ...(undecided > 0
      ? [tile("Undecided", count(undecided), "numerical failures, not accepted")]
      : []),
    ...beyond_tiles(
      Math.round(beyond),
      "populations that figures and levels do not count, but the table of candidates does",
    ),
    ...live_tiles(report),
    ...shown_tiles(candidates),
  ]);
}

const angle_text = (deg) => (deg === null ? "" : String(Number(deg.toPrecision(6))));
const share_text = (share) => (share === null ? "" : percent(share));

// Heads of the table, their meanings, and the text of a level. Some are empty for level 0, the
// first draws, or for the last level.
const kColumns = [
  {
    head: "level",
    about: "Number of the level; level 0: first draws",
    text: ({ level }) => String(level),
  },
  {
    head: "from, °",
    about: "Angle that sheets of the level deploy from; its fraction: nearness to the next sample",
    text: ({ deploys_from_deg }) => angle_text(deploys_from_deg),
  },
  {
    head: "share of draws",
    about: "Share of draws that deploy from the level: mean of the populations",
    text: ({ level, rate }) => (level > 0 ? number(rate) : ""),
  },
  {
    head: "95 % interval",
    about: "From the scatter of the populations",
    text: (level) => (level.level > 0 ? (interval_of(level) ?? "") : ""),
  },
  {
    head: "reach next",
    about: "Share of the particles (draws at level 0) that reach the next level",
    text: ({ reach_next }, is_last) => (is_last ? "" : share_text(reach_next)),
  },
  {
    head: "moves accepted",
    about: "Share of the moves that stayed within the level",
    text: ({ level, taken, tried }) => (level > 0 ? share_text(share_of(taken, tried)) : ""),
  },
  {
    head: "first met",
    about: "Candidates first met at this level",
    text: ({ met }) => count(met),
  },
  {
    head: "core time, s",
    about: "Core seconds spent at this level",
    text: ({ core_s }) => fixed(core_s, 1),
  },
];

function table_of(levels) {
  const last = levels.at(-1);
  const cells = (level) =>
    kColumns.map(({ text }, k) =>
      h(k === 0 ? "th" : "td", k === 0 ? { scope: "row" } : {}, text(level, level === last)),
    );
  return table(
    { class: "levels" },
    kColumns.map(({ head, about }) => [head, about]),
    levels.map((level) => h("tr", { "data-level": level.level }, cells(level))),
  );
}

const rows_of = (levels) => ({
  heads: [
    ...["level", "deploys_from_deg", "share", "low_95", "high_95", "populations_here"],
    ...["reach_next", "ancestors", "tried", "taken", "undecided", "met", "core_s"],
  ],
  rows: levels.map((level) => [
    ...[level.level, level.deploys_from_deg],
    ...[level.rate, level.rate_low, level.rate_high].map(single),
    ...[level.populations_here, single(level.reach_next), level.ancestors],
    ...[level.tried, level.taken, level.undecided, level.met, single(level.core_s)],
  ]),
});

const points_of = (levels) =>
  levels
    .filter(({ level, rate }) => level > 0 && rate > 0)
    .map(({ level, deploys_from_deg, rate, rate_low, rate_high, populations_here }) => ({
      ...{ level, from_deg: deploys_from_deg, share: rate, low: rate_low, high: rate_high },
      reached: populations_here,
    }));

/** Hides the card until a population reaches a level. */
function show_chart(points, { levels, populations }, report) {
  const chart = by_id("ladder-chart"),
    card = chart.closest(".card"),
    ends = [levels[1], levels.at(-1)].map(({ deploys_from_deg }) => deploys_from_deg);
  card.hidden = points.length === 0;
  if (card.hidden) return;
  by_id("ladder-caption").textContent = points.some(({ low }) => low !== null)
    ? "Points with their 95 % intervals."
    : "No intervals yet.";
  show_when_wide(chart, (width) => ladder_chart(points, ends, populations, width));
  add_saving_once(chart, `${report.campaign.name}-ladder`, () =>
    rows_of(with_known_shares(report.state.ladder).levels),
  );
}

function show_levels(ladder, report) {
  const { levels } = ladder,
    missed = levels.find(({ rate }) => rate === 0);
  show_chart(points_of(levels), ladder, report);
  by_id("ladder-levels").replaceChildren(table_of(levels));
  by_id("ladder-words").textContent =
    (missed ? `No population has reached ${degrees(missed.deploys_from_deg)}. ` : "") +
    "Level 0: first draws. “First met” counts each sheet once per population; the catalogue keeps it once.";
}

/** The share is unknown without populations, though the data has 0. */
const with_known_shares = (ladder) =>
  ladder.populations > 0
    ? ladder
    : { ...ladder, levels: ladder.levels.map((level) => ({ ...level, rate: null })) };

/** Shows figures, chart and table; called again whenever the report has changed. */
export function show_ladder(report) {
  const ladder = with_known_shares(report.state.ladder),
    [note, says] = [by_id("ladder-note"), by_id("ladder-says")],
    words = ladder.why_not_converged;
  show_figures(report, ladder);
  by_id("where-draws-fail").hidden = true;
  by_id("ladder").hidden = false;
  says.hidden = words === "";
  says.textContent = words === "" ? "" : `${words[0].toUpperCase()}${words.slice(1)}.`;
  const waits = ladder.levels.length === 0;
  by_id("ladder-cards").hidden = waits;
  note.textContent = waits
    ? kWaits
    : "Share of draws that deploy from each level: the product of the shares of particles that reach the next level. " +
      "It is the mean of all populations, unbiased for any number of particles and moves. Its interval comes from their scatter.";
  if (!waits) show_levels(ladder, report);
}
