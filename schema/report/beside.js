// Compares the picked sheet with a held sheet. State "beside" is the held draw, or "start": the
// draw from which an optimising search made the picked sheet.
import { show_when_wide } from "./chart.js";
import { decode_detail, decode_lengths, detail_of, last_sample_up_to, values_of } from "./data.js";
import { make_folding_view } from "./folding_view.js";
import { by_id, compared, h, table } from "./format.js";
import { make_histories } from "./histories.js";
import { metrics, with_unit } from "./metrics.js";
import { end_of_path, heading, is_pattern } from "./page_kind.js";
import { make_state } from "./state.js";

/** -1 where the first is better, 1 where the second is, 0 where they are equal or unknown. */
function which_is_better({ name, better, none_is_best }, first, second) {
  if (kDescribe.has(name) || first === second || first === undefined || second === undefined)
    return 0;
  if (first === null || second === null) return none_is_best ? (first === null ? -1 : 1) : 0;
  return first < second === (better === "less") ? -1 : 1;
}

const kStart = "start";

// Values that describe a sheet: none of two is the better one.
const kDescribe = new Set([
  ...["elongation_min", "elongation_max", "stretch_sq_mm2", "energy_n_mm", "bent_energy_n_mm"],
  ...["shifted_vertices", "increasing", "decreasing", "kawasaki_defect_deg"],
  ...["singular_value_min", "residual_max", "isometry_error_mm", "deploy_time_s"],
  ...["curvature_1_per_m", "curvature_2_per_m", "yield_amplitude_mm", "start_value"],
]);

/** The held sheet, { name, values, detail }; null if the picked one has no such start. */
function held_sheet(report, candidates, held, picked) {
  if (held !== kStart) {
    return {
      name: heading(report, held),
      values: values_of(report, candidates, held),
      detail: detail_of(report, held),
    };
  }
  const ascent = detail_of(report, picked)?.ascent;
  if (!ascent?.start) return null;
  const name = `${heading(report, picked)}, start`;
  return {
    name,
    values: { ...ascent.start.metrics, end_value: ascent.start_value },
    detail: ascent.start,
  };
}

function comparison(report, candidates, held, picked) {
  const theirs = held.values;
  const ours = values_of(report, candidates, picked);
  const cell = (metric, values, is_better) =>
    compared(with_unit(metric, values[metric.name]), is_better);
  const lines = metrics
    .filter(({ name }) => theirs[name] !== undefined && ours[name] !== undefined)
    .map((metric) => {
      const which = which_is_better(metric, theirs[metric.name], ours[metric.name]);
      return h(
        "tr",
        { "data-metric": metric.name },
        h("th", { scope: "row", title: metric.about }, metric.label),
        cell(metric, ours, which > 0),
        cell(metric, theirs, which < 0),
      );
    });
  const heads = ["Metric", heading(report, picked), held.name];
  return table(
    { class: "beside" },
    heads.map((text) => [text]),
    lines,
  );
}

class Beside {
  #report;
  #candidates;
  #state;
  #inspector;
  #histories = []; // { decoded, chart, state } of the held sheet, and of the picked one
  #held_state = make_state({ sample: 0, diagonal: null });
  #folding = null;
  #held_detail = null;
  #held_samples = 1;

  constructor(report, candidates, state, inspector) {
    [this.#report, this.#candidates, this.#state] = [report, candidates, state];
    this.#inspector = inspector;
    const choice = by_id("hold-choice");
    choice.addEventListener("change", () => state.set("beside", choice.value));
    by_id("release").addEventListener("click", () => state.set("beside", ""));
    state.on("beside", () => this.show());
    state.on("picked", () => this.show());
    state.on("computed", () => this.show());
    state.on("pilot_deg", () => this.#follow());
    state.on("place", () => this.#follow_folding());
    state.on("diagonal", (d) => {
      for (const { chart } of this.#histories) chart.mark(d);
      this.#folding?.mark(d);
    });
    this.show();
  }

  show() {
    const held = this.#state.get("beside"),
      picked = this.#state.get("picked"),
      sheet =
        held !== "" && held !== picked && picked !== null
          ? held_sheet(this.#report, this.#candidates, held, picked)
          : null;
    by_id("beside-card").hidden = held === "";
    this.#show_choice(held, picked);
    by_id("beside-words").textContent =
      sheet || held === ""
        ? "Bold: the better value, where one is better."
        : held === kStart
          ? "Compares each sheet with the start of its ascent. Pick a sheet with all details."
          : `Compares with ${heading(this.#report, held).toLowerCase()}. Pick another sheet: in the table below, or by the arrows above.`;
    by_id("beside").replaceChildren(
      ...(sheet ? [comparison(this.#report, this.#candidates, sheet, picked)] : []),
    );
    this.#show_folding(sheet);
    this.#show_histories(sheet);
    this.#follow();
  }

  /** Offers the start of the picked sheet, itself for what is picked next, and all with details. */
  #show_choice(held, picked) {
    const report = this.#report,
      draws = new Set([picked, ...report.details.map(({ draw }) => draw), held]),
      words = (draw) => heading(report, draw) + (draw === picked ? ", then pick another" : "");
    const choice = by_id("hold-choice");
    for (const none of [null, "", kStart]) draws.delete(none);
    choice.parentNode.hidden = picked === null || is_pattern(report);
    choice.replaceChildren(
      h("option", { value: "" }, "–"),
      held === kStart || held_sheet(report, this.#candidates, kStart, picked)
        ? h("option", { value: kStart }, "its start")
        : "",
      ...[...draws].map((draw) => h("option", { value: draw }, words(draw))),
    );
    choice.value = held;
  }

  /** Shows the held sheet next to the picked one, by the same camera. */
  #show_folding(sheet) {
    const report = this.#report,
      detail = sheet?.detail,
      has_shape = Boolean(detail?.vertices_mm);
    by_id("held-card").hidden = !has_shape;
    by_id("stage").classList.toggle("two", has_shape);
    if (!has_shape) return;
    by_id("held-title").textContent = sheet.name;
    this.#folding ??= make_folding_view(
      by_id("held-folding"),
      by_id("held-caption"),
      report,
      this.#held_state,
      this.#inspector.camera,
    );
    if (detail === this.#held_detail) return;
    const decoded = decode_detail(detail, report);
    [this.#held_detail, this.#held_samples] = [detail, decoded.samples];
    this.#folding.load(detail, decoded);
  }

  #show_histories(sheet) {
    const report = this.#report,
      own = detail_of(report, this.#state.get("picked"));
    this.#histories = [];
    const show = (id, detail, name, state) => {
      const box = by_id(id).querySelector("div");
      by_id(id).hidden = !detail;
      if (!detail) return void box.replaceChildren();
      const decoded = decode_lengths(detail, report),
        along = { state, detail, decoded, end_deg: end_of_path(report) },
        entry = { decoded, state, chart: make_histories(h("p"), report, along) };
      this.#histories.push(entry);
      by_id(id).querySelector("figcaption").textContent =
        `Lengths of the diagonals of ${name.toLowerCase()}`;
      show_when_wide(box, (width) => entry.chart.draw(width), "now");
    };
    show(
      "beside-own",
      sheet && own,
      heading(report, own?.draw),
      make_state({ sample: 0, diagonal: null }),
    );
    show("beside-figure", sheet?.detail, sheet?.name, this.#held_state);
  }

  // Shows both at the pilot angle of the picked one.
  #follow() {
    const pilot_deg = this.#state.get("pilot_deg");
    if (pilot_deg === null) return;
    for (const { decoded, state, chart } of this.#histories) {
      state.set("sample", last_sample_up_to(decoded.pilot_deg, pilot_deg));
      chart.move();
    }
    this.#follow_folding();
  }

  #follow_folding() {
    if (by_id("held-card").hidden) return;
    const place = this.#state.get("place");
    this.#folding.pose(place === null ? null : Math.min(place, this.#held_samples - 1));
  }
}

export const make_beside = (...of) => new Beside(...of);
