// Shows the selected draw: its data, and the views that move together.
import { make_actuation, show_actuation_words } from "./actuation.js";
import { show_ascent } from "./ascent.js";
import {
  show_certificate,
  show_metrics,
  show_no_details,
  show_shifts,
  show_yields,
  verdict_words,
} from "./candidate.js";
import { show_when_wide } from "./chart.js";
import { show_commands } from "./commands.js";
import { show_contact } from "./contact.js";
import { make_crease_pattern } from "./crease_pattern.js";
import { decode_detail, detail_of, last_sample_up_to, values_of } from "./data.js";
import { save_details } from "./detail_files.js";
import { make_folding_view } from "./folding_view.js";
import { by_id, count, degrees } from "./format.js";
import { make_diagonal_list, make_histories } from "./histories.js";
import { metric_of, with_unit } from "./metrics.js";
import { make_deployment } from "./deployment.js";
import { make_pilot } from "./pilot.js";
import { make_stress } from "./stress.js";
import { end_of_path, heading, is_pattern, population_words } from "./page_kind.js";
import { show_sheet_facts } from "./sheet_facts.js";

const kFirstPilot_deg = 80; // a pose that shows the fold well
const kReplaced = "This file now holds another campaign. Reload the page.";

function margin_words(values) {
  const name = values.miscut_margin_mm ? "miscut_margin_mm" : "slope_min_mm_per_deg";
  return with_unit(metric_of[name], values[name]);
}

const place_chart = (box, chart) => show_when_wide(box, (width) => chart.draw(width), "now");

/** Shows one draw; makes its parts again for another draw. */
export class Inspector {
  #report;
  #candidates;
  #state;
  #end_deg;
  #pilot;
  #views = null; // folding and crease pattern, shared by all draws
  #parts = [];
  #shown = null; // the details of the sheet whose folding is shown
  #decoded = null; // and its histories

  constructor(report, candidates, state) {
    [this.#report, this.#candidates, this.#state] = [report, candidates, state];
    this.#end_deg = end_of_path(report);
    this.#pilot = make_pilot(by_id("pilot-bar"), state);
    state.on("sample", () => this.#parts.forEach((part) => part.move?.()));
    state.on("at", (at) => {
      if (!this.#decoded || (at === "" && state.get("playing"))) return;
      state.set("playing", false);
      const angle_deg = this.#angle_of(this.#shown);
      state.set("sample", last_sample_up_to(this.#decoded.pilot_deg, angle_deg));
    });
    state.on("place", (place) => {
      if (this.#decoded) this.#views.folding.pose(place);
    });
    state.on("diagonal", (d) => this.#parts.forEach((part) => part.mark?.(d)));
  }

  get camera() {
    return this.#shared_views().folding.camera;
  }

  move_by_itself() {
    if (this.#decoded) this.#pilot.run_by_itself(by_id("folding"));
  }

  show(draw) {
    this.show_sheet(draw);
    this.show_details(draw);
  }

  /** Shows the histories, forces and facts of the sheet that show_sheet has shown. */
  show_details(draw) {
    const report = this.#report,
      detail = detail_of(report, draw),
      known = values_of(report, this.#candidates, draw);
    by_id("views").hidden = !detail;
    by_id("shifts-card").hidden = !detail;
    if (detail) this.#show_detail(detail);
    show_metrics(
      by_id("metrics"),
      Object.keys(known).length ? known : null,
      this.#candidates,
      report,
    );
    show_ascent(by_id("ascent"), detail);
    show_certificate(by_id("certificate"), report, draw);
    show_yields(by_id("yields"), report, draw);
  }

  /** Shows the folding, its verdict and first figures. */
  show_sheet(draw) {
    const report = this.#report,
      detail = detail_of(report, draw),
      known = values_of(report, this.#candidates, draw),
      state = this.#state,
      row = this.#candidates.row_of.get(draw);
    by_id("sheet-of").textContent = is_pattern(report) ? "Pattern" : report.campaign.name;
    by_id("picked-title").textContent =
      heading(report, draw) + (row === undefined ? "" : ` · rank ${count(row + 1)}`);
    by_id("inspect-title").textContent =
      `Details of ${is_pattern(report) ? "the sheet" : heading(report, draw).toLowerCase()}`;
    by_id("picked-words").textContent =
      (detail
        ? verdict_words(detail)
        : `Accepted. Deploys from ${degrees(known.deploys_from_deg)}, with a margin of ${margin_words(known)}.`) +
      population_words(report, draw);
    show_sheet_facts(by_id("sheet-facts"), report, draw, known, detail);
    show_commands(by_id("sheet-next"), by_id("commands"), report, draw, {
      is_certified: report.certificates?.some((entry) => entry.draw === draw),
      is_accepted: detail ? detail.accepted !== false : row !== undefined,
      deploys: known.deploys_from_deg > 0 && detail?.accepted !== false,
    });
    by_id("folding-card").hidden = !detail;
    by_id("no-details").hidden = Boolean(detail);
    this.#parts = [];
    [this.#shown, this.#decoded] = [detail, null];
    if (detail) return this.#show_folding(detail);
    state.set("playing", false);
    state.set("pilot_deg", null);
    this.#pilot.name(heading(report, draw));
    show_no_details(by_id("no-details"), report, draw, (wanted) => this.#compute(wanted));
  }

  /** Shows a draw that the program folds; answers with a sentence where that fails. */
  async #compute(draw) {
    const report = this.#report;
    let answer;
    try {
      answer = await (await fetch(report.watch.sheet + draw)).json();
    } catch {
      answer = { problem: "The program that serves this page does not answer." };
    }
    if (answer.problem) return answer.problem;
    if (answer.identity !== report.campaign.identity) return kReplaced;
    if (!this.#candidates.detailed.has(draw)) {
      report.details.push(answer.detail);
      this.#candidates.detailed.add(draw);
      this.#state.set("computed", draw);
    }
    if (this.#state.get("picked") === draw) this.show(draw);
    return null;
  }

  #shared_views() {
    const report = this.#report,
      state = this.#state;
    return (this.#views ??= {
      folding: make_folding_view(by_id("folding"), by_id("folding-caption"), report, state),
    });
  }

  /** The pilot angle at which a sheet is shown first: the address's, that of use, or a usual one. */
  #angle_of(detail) {
    const at = this.#state.get("at");
    return at === "" ? (detail.from_deg ?? kFirstPilot_deg) : Number(at);
  }

  #show_folding(detail) {
    const state = this.#state,
      decoded = (this.#decoded = decode_detail(detail, this.#report));
    const was_playing = state.get("playing");
    state.set("playing", false);
    state.set("diagonal", null);
    // The pilot angle stays, so that two draws can be compared.
    state.set(
      "sample",
      last_sample_up_to(decoded.pilot_deg, state.get("pilot_deg") ?? this.#angle_of(detail)),
    );
    state.set("pilot_deg", decoded.pilot_deg[state.get("sample")]);
    const { folding } = this.#shared_views();
    this.#pilot.load(detail, decoded, heading(this.#report, detail.draw));
    folding.load(detail, decoded);
    this.#parts = [
      {
        move: () => state.get("place") === null && folding.pose(state.get("sample")),
        mark: (d) => folding.mark(d),
      },
      this.#pilot,
      { move: () => state.set("pilot_deg", decoded.pilot_deg[state.get("sample")]) },
    ];
    state.set("playing", was_playing);
  }

  #show_detail(detail) {
    const report = this.#report,
      state = this.#state,
      decoded = this.#decoded;
    const crease = (this.#views.crease ??= make_crease_pattern(
      by_id("crease"),
      by_id("crease-caption"),
      report,
      state,
    ));
    crease.load(detail, decoded);
    const list = make_diagonal_list(by_id("diagonals"), report, detail, decoded, state);
    const along = { state, detail, decoded, end_deg: this.#end_deg };
    const histories = make_histories(by_id("histories-caption"), report, along);
    place_chart(by_id("histories"), histories);
    const actuation = make_actuation(report, along, ({ box, chart }) => place_chart(box, chart));
    for (const { box, chart } of actuation) place_chart(box, chart);
    const deployment = make_deployment(report, along);
    if (deployment) place_chart(by_id("let-go"), deployment);
    for (const { box, chart } of make_stress(report, detail, decoded)) place_chart(box, chart);
    show_contact(detail);
    show_actuation_words(by_id("actuation"), report, detail, decoded);
    show_shifts(by_id("shifts"), detail);
    save_details(report, detail, decoded, state, crease.drawing);
    this.#parts.push({ mark: (d) => crease.mark(d) }, list, histories, {
      move: () => actuation.forEach(({ chart }) => chart.move()),
    });
    list.move();
  }
}
