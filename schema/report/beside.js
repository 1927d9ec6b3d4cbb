// Compares the picked sheet with a held sheet. State "beside" is the held draw, or "start": the
// draw from which an optimising search made the picked sheet.
import { show_when_wide } from "./chart.js";
import { decode_lengths, last_sample_up_to, values_of } from "./data.js";
import { by_id, h } from "./format.js";
import { make_histories } from "./histories.js";
import { metrics, with_unit } from "./metrics.js";
import { end_of_path, heading, is_pattern } from "./page_kind.js";
import { make_state } from "./state.js";

/** -1 where the first is better, 1 where the second is, 0 where they are equal or unknown. */
function which_is_better({ better, none_is_best }, first, second) {
  if (first === second || first === undefined || second === undefined) return 0;
  if (first === null || second === null) return none_is_best ? (first === null ? -1 : 1) : 0;
  return first < second === (better === "less") ? -1 : 1;
}

const kStart = "start";

/** The held sheet, { name, values, detail }; null if the picked one has no such start. */
function held_sheet(report, candidates, held, picked) {
  const detail_of = (draw) => report.details.find((entry) => entry.draw === draw);
  if (held !== kStart) {
    return {
      name: heading(report, held),
      values: values_of(report, candidates, held),
      detail: detail_of(held),
    };
  }
  const ascent = detail_of(picked)?.ascent;
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
    h(
      "td",
      is_better ? { class: "better", title: "The better of the two" } : {},
      with_unit(metric, values[metric.name]),
    );
  const lines = metrics
    .filter(({ name }) => theirs[name] !== undefined && ours[name] !== undefined)
    .map((metric) => {
      const which = which_is_better(metric, theirs[metric.name], ours[metric.name]);
      return h(
        "tr",
        { "data-metric": metric.name },
        h("th", { scope: "row", title: metric.about }, metric.label),
        cell(metric, theirs, which < 0),
        cell(metric, ours, which > 0),
      );
    });
  const heads = ["", held.name, heading(report, picked)];
  return h(
    "table",
    { class: "beside" },
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        heads.map((text) => h("th", { scope: "col" }, text)),
      ),
    ),
    h("tbody", {}, lines),
  );
}

class Beside {
  #report;
  #candidates;
  #state;
  #histories = null;
  #redraw = null;
  #held_state = make_state({ sample: 0, diagonal: null });

  constructor(report, candidates, state) {
    [this.#report, this.#candidates, this.#state] = [report, candidates, state];
    by_id("beside-card").hidden = is_pattern(report);
    by_id("hold").addEventListener("click", () => state.set("beside", state.get("picked")));
    by_id("hold-start").addEventListener("click", () => state.set("beside", kStart));
    by_id("release").addEventListener("click", () => state.set("beside", ""));
    state.on("beside", () => this.show());
    state.on("picked", () => this.show());
    state.on("computed", () => this.show());
    state.on("pilot_deg", () => this.#follow());
    state.on("diagonal", (d) => this.#histories?.chart.mark(d));
    this.show();
  }

  show() {
    const held = this.#state.get("beside"),
      picked = this.#state.get("picked"),
      sheet =
        held !== "" && held !== picked && picked !== null
          ? held_sheet(this.#report, this.#candidates, held, picked)
          : null;
    by_id("hold").hidden = held === picked;
    by_id("hold-start").hidden =
      held === kStart || !held_sheet(this.#report, this.#candidates, kStart, picked);
    by_id("release").hidden = held === "";
    by_id("beside-words").textContent =
      held === ""
        ? "Compares the metrics and diagonals of two sheets. Press the button, then pick another sheet."
        : sheet
          ? "Bold: the better value."
          : held === kStart
            ? "Compares each sheet with the start of its ascent. Pick a sheet with all details."
            : `Compares with ${heading(this.#report, held).toLowerCase()}. Pick another sheet.`;
    by_id("beside").replaceChildren(
      ...(sheet ? [comparison(this.#report, this.#candidates, sheet, picked)] : []),
    );
    this.#show_histories(sheet);
  }

  #show_histories(sheet) {
    const report = this.#report,
      detail = sheet?.detail;
    by_id("beside-figure").hidden = !detail;
    this.#histories = null;
    if (!detail) {
      by_id("beside-histories").replaceChildren();
      return;
    }
    const decoded = decode_lengths(detail, report);
    by_id("beside-title").textContent = `Lengths of the diagonals of ${sheet.name.toLowerCase()}`;
    const along = { state: this.#held_state, detail, decoded, end_deg: end_of_path(report) };
    this.#histories = { decoded, chart: make_histories(h("p"), report, along) };
    this.#follow();
    this.#redraw ??= show_when_wide(by_id("beside-histories"), (width) =>
      this.#histories ? this.#histories.chart.draw(width) : h("span"),
    );
    this.#redraw();
  }

  // Shows the held sheet at the pilot angle of the picked one.
  #follow() {
    const pilot_deg = this.#state.get("pilot_deg");
    if (!this.#histories || pilot_deg === null) return;
    this.#held_state.set("sample", last_sample_up_to(this.#histories.decoded.pilot_deg, pilot_deg));
    this.#histories.chart.move();
  }
}

export const make_beside = (report, candidates, state) => new Beside(report, candidates, state);
