// The page of `misalign report`: overview, choose, inspect.
import { show_acceptance } from "./acceptance.js";
import { make_actuation, show_actuation_words } from "./actuation.js";
import {
  show_commands,
  show_metrics,
  show_no_details,
  show_shifts,
  verdict_words,
} from "./candidate.js";
import { show_when_wide } from "./chart.js";
import { show_crease_pattern } from "./crease_pattern.js";
import { decode_detail, last_sample_up_to, read_candidates, read_report } from "./data.js";
import { parse_filter } from "./filter.js";
import { make_folding_view } from "./folding_view.js";
import { count, degrees, h, plural } from "./format.js";
import { make_diagonal_list, make_histories } from "./histories.js";
import { metric_of, with_unit } from "./metrics.js";
import { make_pilot } from "./pilot.js";
import { make_scatter } from "./scatter.js";
import { make_state } from "./state.js";
import { make_filter, make_table } from "./table.js";
import { set_up_theme } from "./theme.js";

const by_id = (id) => document.getElementById(id);
const kFirstPilot_deg = 80; // a pose that shows the fold well

function show_candidates(report, candidates, state) {
  const { total, shown } = report.candidates,
    { deploys_from_deg } = report.campaign.configuration.accept;
  const note = by_id("candidates-note");
  if (candidates.count === 0) {
    by_id("chooser").hidden = true;
    note.textContent =
      `No draw has been accepted yet: ${report.state.draws ? `none of ${count(report.state.draws)} deploys from ${degrees(deploys_from_deg)} or more` : "nothing has been drawn"}. ` +
      "Run the same search again with more draws; it goes on where it ended. Or choose a lower accept.deploys_from_deg, which is another campaign. " +
      "Any draw, accepted or not, can be looked at with --draw.";
    return;
  }
  note.textContent =
    (shown < total
      ? `The best ${count(shown)} of ${count(total)} candidates`
      : plural(total, "candidate")) +
    `, best first: the deepest D, then the largest margin. ` +
    `● marks ${plural(candidates.detailed.size, "draw")} with all details in this report. The one that is picked is shown below.`;
  const table = make_table(by_id("table"), candidates, state);
  make_scatter(by_id("scatter"), candidates, state);
  const say = make_filter(candidates, table, parse_filter);
  state.on("order", say);
  say(state.get("order"));
}

/** Goes through the draws that can be looked at. */
function show_detailed(report, candidates, state) {
  const draws = report.details.map(({ draw }) => draw);
  if (draws.length === 0) return;
  const words = ({ draw, verdict }) => {
    const row = candidates.row_of.get(draw);
    return `draw ${draw}: D ${degrees(verdict.deploys_from_deg)}${row === undefined ? ", asked for" : `, rank ${count(row + 1)}`}`;
  };
  const other = h("option", { value: "", disabled: true }, "without details");
  const select = h(
    "select",
    { "aria-label": "Draws with details", "data-testid": "detailed" },
    other,
    ...report.details.map((detail) => h("option", { value: detail.draw }, words(detail))),
  );
  const step = (by) =>
    state.set(
      "picked",
      draws[Math.max(0, Math.min(draws.length - 1, draws.indexOf(state.get("picked")) + by))],
    );
  const [previous, next] = [
    h("button", { type: "button", title: "The one before", onclick: () => step(-1) }, "‹"),
    h("button", { type: "button", title: "The next one", onclick: () => step(1) }, "›"),
  ];
  select.addEventListener("change", () => state.set("picked", select.value));
  by_id("detailed").append(
    h("span", { class: "note" }, `${plural(draws.length, "draw")} with details`),
    previous,
    select,
    next,
  );
  state.on("picked", (picked) => {
    const at = draws.indexOf(picked);
    select.value = at < 0 ? "" : picked;
    previous.disabled = at <= 0;
    next.disabled = at === draws.length - 1;
  });
}

/** Everything about one draw; built anew whenever another one is picked. */
function make_inspector(report, candidates, state) {
  const { end_deg } = report.campaign.configuration.path;
  let folding = null,
    pilot = null,
    parts = [];
  const redraws = [];
  const charts = new Map(); // box → what draws it now: each box is watched once

  function place_chart(box, chart) {
    const known = charts.has(box);
    charts.set(box, chart);
    if (known) redraws.find((entry) => entry.box === box).redraw();
    else redraws.push({ box, redraw: show_when_wide(box, (width) => charts.get(box).draw(width)) });
  }

  function show_detail(detail) {
    const decoded = decode_detail(detail, report);
    state.set("playing", false);
    state.set("diagonal", null);
    const before = state.get("pilot_deg") ?? kFirstPilot_deg;
    parts = [];
    // The same pilot angle as for the draw before, so that two can be compared.
    state.set("sample", last_sample_up_to(decoded.pilot_deg, before));
    state.set("pilot_deg", decoded.pilot_deg[state.get("sample")]);
    pilot ??= make_pilot(by_id("pilot-bar"), state);
    folding ??= make_folding_view(by_id("folding"), by_id("folding-caption"), report, state);
    const mark_crease = show_crease_pattern(
      by_id("crease"),
      by_id("crease-caption"),
      report,
      detail,
      decoded,
      state,
    );
    const list = make_diagonal_list(by_id("diagonals"), report, detail, decoded, state);
    const histories = make_histories(
      by_id("histories"),
      by_id("histories-caption"),
      report,
      detail,
      decoded,
      state,
      end_deg,
    );
    let actuation = make_actuation(report, detail, decoded, state, end_deg);
    place_chart(by_id("histories"), histories);
    for (const [box, chart] of actuation) place_chart(box, chart);
    pilot.load(detail, decoded);
    folding.load(decoded);
    show_actuation_words(by_id("actuation"), report, detail, decoded);
    show_shifts(by_id("shifts"), detail, state);
    parts = [
      { move: () => folding.pose(state.get("sample")), mark: folding.mark },
      { mark: mark_crease },
      list,
      histories,
      pilot,
      { move: () => actuation.forEach(([, chart]) => chart.move()) },
      { move: () => state.set("pilot_deg", decoded.pilot_deg[state.get("sample")]) },
    ];
    list.move();
    by_id("log").onchange = () => {
      actuation = make_actuation(report, detail, decoded, state, end_deg);
      for (const [box, chart] of actuation) place_chart(box, chart);
    };
  }

  state.on("sample", () => parts.forEach((part) => part.move?.()));
  state.on("diagonal", (d) => parts.forEach((part) => part.mark?.(d)));

  return (draw) => {
    const detail = report.details.find((entry) => entry.draw === draw),
      row = candidates.row_of.get(draw);
    const values = detail
      ? detail.metrics
      : row === undefined
        ? null
        : Object.fromEntries(
            Object.entries(candidates.columns).map(([name, column]) => [name, column[row]]),
          );
    by_id("picked-title").textContent =
      `Draw ${draw}` + (row === undefined ? "" : ` · rank ${count(row + 1)}`);
    by_id("picked-words").textContent = detail
      ? verdict_words(detail)
      : `Accepted. Deploys from ${degrees(values.deploys_from_deg)}, with a margin of ${with_unit(metric_of.slope_min_mm_per_deg, values.slope_min_mm_per_deg)}.`;
    by_id("views").hidden = !detail;
    by_id("no-details").hidden = Boolean(detail);
    by_id("shifts-card").hidden = !detail;
    parts = [];
    if (detail) show_detail(detail);
    else {
      state.set("playing", false);
      state.set("pilot_deg", null);
      show_no_details(by_id("no-details"), report, draw, state);
    }
    show_metrics(by_id("metrics"), values, candidates);
    show_commands(by_id("commands"), report, draw, state);
  };
}

function main() {
  set_up_theme(by_id("theme"));
  let report;
  try {
    report = read_report();
  } catch (error) {
    by_id("broken").textContent = error.message;
    by_id("broken").hidden = false;
    for (const section of document.querySelectorAll("section")) section.hidden = true;
    return;
  }
  const state = make_state({
    picked: null,
    sample: 0,
    pilot_deg: null,
    diagonal: null,
    order: null,
    playing: false,
    said: "",
  });
  const candidates = read_candidates(report);
  Object.defineProperty(window, "misalign", {
    value: Object.freeze({
      get picked() {
        return state.get("picked");
      },
      get pilot_deg() {
        return state.get("pilot_deg");
      },
      get filtered() {
        return state.get("order")?.length ?? 0;
      },
    }),
  });

  show_acceptance(report);
  show_candidates(report, candidates, state);
  show_detailed(report, candidates, state);
  state.on("picked", make_inspector(report, candidates, state));
  state.on("said", (words) => (by_id("said").textContent = words));
  const first = report.details[0]?.draw ?? candidates.columns.draw[0];
  if (first === undefined) {
    by_id("picked-title").textContent = "No draw to inspect";
    by_id("picked-words").textContent =
      `“${report.commands.misalign} report ${report.commands.catalogue} --draw N${report.commands.choice} --output ${report.commands.output}” shows any draw, accepted or not.`;
    for (const id of ["no-details", "facts"]) by_id(id).hidden = true;
  } else state.set("picked", first);

  const { version, commit } = report.program;
  by_id("foot").append(
    `Written by misalign ${version} (${commit}) on ${report.written_at} from ${report.catalogue}; campaign ${report.campaign.identity}. `,
    "Paper: Saito, Tsukahara & Okabe, Proc. R. Soc. A 472 (2016) 20150235. Drawn with three.js, Observable Plot and D3.",
  );
}

main();
