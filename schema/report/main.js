// Sets up the page of `misalign report`: overview, choice of a candidate, and the selected draw.
import { draw_in_address, follow_address } from "./address.js";
import { make_beside } from "./beside.js";
import { read_candidates, read_report } from "./data.js";
import { make_columns_menu } from "./columns_menu.js";
import { make_filter_field } from "./filter_field.js";
import { by_id, clamp, count, degrees, h, plural } from "./format.js";
import { pictures } from "./folding_view.js";
import { Inspector } from "./inspector.js";
import { show_overview } from "./overview.js";
import { make_scatter } from "./scatter.js";
import { first_axes, metrics_of } from "./scatter_axes.js";
import { filter_of_design, make_limits } from "./limits.js";
import { make_parallel } from "./parallel.js";
import { link_manual } from "./manual.js";
import { make_state } from "./state.js";
import { make_table, save_rows } from "./table.js";
import { is_choice, is_order } from "./table_columns.js";
import { set_up_theme } from "./theme.js";
import { show_two_campaigns } from "./two_campaigns.js";
import { watch } from "./watch.js";
import { is_pattern, is_splitting, noun, noun_first, show_pattern } from "./page_kind.js";

/** Describes the choice of draws with details. */
function chosen_words(report) {
  const { chosen, details } = report,
    { best, diverse, where, by, draws } = chosen;
  if (!details.length || !(draws || best || diverse || where)) return "";
  const asked = draws ? plural(draws, `requested ${noun(report)}`) : "";
  const of_those = where ? ` among those with ${where}` : "";
  const sorted = !by || by === "deploys_from_deg" ? "" : ` by ${by}`;
  const rest = diverse
    ? `a spread of ${diverse} that differ most${of_those}`
    : best || where
      ? `the best${sorted}${of_those}`
      : "the best";
  return `: ${[asked, rest].filter(Boolean).join(", and ")}`;
}

/** Describes the program's own order, which depends on the catalogue's columns. */
const order_words = ({ columns }) =>
  (columns.goes_back ? "those without reversals first, then " : "") +
  `the largest D, then the largest ${columns.miscut_margin_mm ? "margin against miscuts" : "margin"}`;

/** Says that there are no candidates, and what can be done. */
function nothing_words(report) {
  const { state, campaign } = report,
    { deploys_from_deg } = campaign.configuration.accept,
    lower = "it resumes. Or make another campaign with a lower accept.deploys_from_deg.";
  if (is_splitting(report)) {
    const met = state.ladder.populations
      ? `none of ${plural(state.ladder.populations, "population")} met a sheet that deploys from ${degrees(deploys_from_deg)} or more`
      : "no population has been searched";
    return `No sheet has been accepted yet: ${met}. Run the same search again${state.complete ? " with more populations" : ""}; ${lower}`;
  }
  const drawn = state.draws
    ? `none of ${count(state.draws)} deploys from ${degrees(deploys_from_deg)} or more`
    : "no draw yet";
  return `No draw has been accepted yet: ${drawn}. Run the same search again with more draws; ${lower} The option --draw shows any draw, accepted or not.`;
}

/** Shows the choice of candidates; returns the table, if there are any. */
function show_candidates(report, candidates, state) {
  const { total, shown } = report.candidates;
  const note = by_id("candidates-note");
  if (candidates.count === 0) {
    by_id("chooser").hidden = true;
    note.textContent = nothing_words(report);
    return null;
  }
  note.textContent =
    (shown < total
      ? `The best ${count(shown)} of ${plural(total, "candidate")}`
      : plural(total, "candidate")) +
    `, in the order: ${order_words(candidates)}. ` +
    `● marks ${plural(candidates.detailed.size, noun(report))} with all details in this report${chosen_words(report)}. The picked ${noun(report)} is shown above.`;
  const { name } = report.campaign;
  const table = make_table(by_id("table"), candidates, state);
  make_scatter(by_id("scatter"), candidates, state, name);
  make_parallel(by_id("parallel"), candidates, state);
  make_filter_field(report, candidates, table, state);
  make_limits(report, candidates, state);
  make_columns_menu(report, candidates, state);
  by_id("rows-save").addEventListener("click", () =>
    save_rows(candidates, state.get("order"), name),
  );
  return table;
}

/** Adds the choice among draws with details. */
function show_detailed(report, candidates, state) {
  const draws = report.details.map(({ draw }) => draw);
  if (draws.length === 0) return;
  const how_many = () => `${plural(draws.length, noun(report))} with details`;
  const words = ({ draw, verdict }) => {
    const row = candidates.row_of.get(draw);
    return `${noun(report)} ${draw}: D ${degrees(verdict.deploys_from_deg)}${row === undefined ? ", requested" : `, rank ${count(row + 1)}`}`;
  };
  const other = h("option", { value: "", disabled: true }, "without details");
  const select = h(
    "select",
    { "aria-label": `${noun_first(report)}s with details`, "data-testid": "detailed" },
    other,
    ...report.details.map((detail) => h("option", { value: detail.draw }, words(detail))),
  );
  const step = (by) =>
    state.set("picked", draws[clamp(draws.indexOf(state.get("picked")) + by, 0, draws.length - 1)]);
  const [previous, next] = [
    h(
      "button",
      { type: "button", title: `Previous ${noun(report)} with details`, onclick: () => step(-1) },
      "‹",
    ),
    h(
      "button",
      { type: "button", title: `Next ${noun(report)} with details`, onclick: () => step(1) },
      "›",
    ),
  ];
  select.addEventListener("change", () => state.set("picked", select.value));
  const said = h("span", { class: "note" }, how_many());
  by_id("detailed").append(said, previous, select, next);
  const show_place = () => {
    const picked = state.get("picked"),
      at = draws.indexOf(picked);
    select.value = at < 0 ? "" : picked;
    previous.disabled = at <= 0;
    next.disabled = at === draws.length - 1;
  };
  state.on("picked", show_place);
  state.on("computed", (draw) => {
    draws.push(draw);
    select.append(h("option", { value: draw }, words(report.details.at(-1))));
    said.textContent = how_many();
    show_place();
  });
}

/** Gives programs that drive the page read access to its state. */
function answer_questions(state) {
  Object.defineProperty(window, "misalign", {
    value: Object.freeze({
      get picked() {
        return state.get("picked");
      },
      get pilot_deg() {
        return state.get("pilot_deg");
      },
      /** Pictures of the folding drawn so far, and when the first was (ms after the page's begin). */
      get pictures() {
        return pictures.count;
      },
      get first_picture_ms() {
        return performance.getEntriesByName("first-picture")[0]?.startTime ?? null;
      },
      get filtered() {
        return state.get("order")?.length ?? 0;
      },
    }),
  });
}

function show_words_instead(words) {
  by_id("broken").textContent = words;
  by_id("broken").hidden = false;
  for (const section of document.querySelectorAll("section")) section.hidden = true;
}

/** The page's report, or null and a sentence instead of the page. */
function report_or_words() {
  try {
    const report = read_report();
    if (report.watch?.problem === undefined) return report;
    show_words_instead(report.watch.problem);
    watch(report, () => {});
  } catch (error) {
    show_words_instead(error.message);
  }
  return null;
}

function show_foot({ program, written_at, catalogue, campaign }) {
  by_id("foot").append(
    `Written by misalign ${program.version} (${program.commit}) on ${written_at} from ${catalogue}${campaign ? `; campaign ${campaign.identity}` : ""}. `,
    "Paper: Saito, Tsukahara & Okabe, Proc. R. Soc. A 472 (2016) 20150235. Drawn with three.js, Observable Plot and D3.",
  );
}

function show_nothing_to_inspect(report) {
  const { misalign, catalogue, choice, output } = report.commands;
  by_id("picked-title").textContent = `No ${noun(report)} to inspect`;
  by_id("picked-words").textContent = is_splitting(report)
    ? "A splitting search keeps only candidates."
    : `“${misalign} report ${catalogue} --draw N${choice} --output ${output}” shows any draw, accepted or not.`;
  for (const id of ["no-details", "stage", "pilot-bar", "inspect"]) by_id(id).hidden = true;
}

function follow_the_address(candidates, table, state, first) {
  const detailed = (draw) => candidates.detailed.has(draw);
  const known = {
    picked: (draw) => candidates.row_of.has(draw) || detailed(draw),
    filter: () => true, // errors are shown below the field
    beside: (draw) => draw === "start" || candidates.row_of.has(draw) || detailed(draw),
    sort: (words) => is_order(words, candidates),
    columns: (words) => is_choice(words, candidates),
    at: (words) => Number(words) >= 0 && Number(words) <= 180,
    across: (name) => metrics_of(candidates).some((metric) => metric.name === name),
  };
  known.up = known.across;
  follow_address(state, {
    first,
    knows: (name, value) => known[name](value),
    complain(words) {
      by_id("address-says").textContent = words;
      by_id("address-says").hidden = words === "";
    },
    restored: () => table?.reveal(state.get("picked")),
  });
}

/** The draw that is shown first: the address's, if the page has it, or the best with details. */
function first_draw(candidates, otherwise) {
  const named = draw_in_address(),
    has = candidates.row_of.has(named) || candidates.detailed.has(named);
  return has ? named : otherwise;
}

const next_frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

/** Shows the sheet first, and the rest once it has been drawn. */
async function main() {
  set_up_theme(by_id("theme"));
  const report = report_or_words();
  if (!report) return;
  const candidates = read_candidates(report);
  const first = report.details[0]?.draw ?? candidates.columns.draw[0] ?? null;
  const state = make_state({
    picked: first_draw(candidates, first),
    hovered: null, // the draw under the pointer
    computed: null, // the draw that was folded last for this page
    filter: is_pattern(report) ? "" : filter_of_design(report, candidates),
    sort: "",
    columns: "", // all of them
    beside: "", // no draw is held
    ...first_axes(candidates),
    at: "", // the pilot angle at which the reader has stopped
    sample: 0,
    place: null, // among the samples, while the sheet moves
    pilot_deg: null,
    diagonal: null,
    order: null,
    playing: false,
  });
  const inspector = new Inspector(report, candidates, state);
  if (first === null) show_nothing_to_inspect(report);
  else {
    inspector.show_sheet(state.get("picked"));
    await next_frame();
    inspector.show_details(state.get("picked"));
  }
  let table = null;
  if (is_pattern(report)) show_pattern(report);
  else {
    show_overview(report);
    show_two_campaigns(report);
    table = show_candidates(report, candidates, state);
    show_detailed(report, candidates, state);
  }
  make_beside(report, candidates, state, inspector);
  state.on("picked", (draw) => inspector.show(draw));
  if (first !== null) {
    follow_the_address(candidates, table, state, first);
    inspector.move_by_itself();
  }
  link_manual(report);
  show_foot(report);
  watch(report, show_overview);
  answer_questions(state);
}

main();
