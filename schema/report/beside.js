// Two sheets side by side: the one that is picked, and one that is held. State "beside" is its draw,
// or "start": the draw from which an optimising search made the one that is picked.
import { show_when_wide } from "./chart.js";
import { decode_lengths, last_sample_up_to, values_of } from "./data.js";
import { by_id, h } from "./format.js";
import { make_histories } from "./histories.js";
import { metrics, with_unit } from "./metrics.js";
import { end_of_path, heading, is_pattern } from "./page_kind.js";
import { make_state } from "./state.js";

/** -1 where the first is better, 1 where the second is, 0 where none is or nobody knows. */
function which_is_better({ better, none_is_best }, first, second) {
  if (first === second || first === undefined || second === undefined) return 0;
  if (first === null || second === null) return none_is_best ? (first === null ? -1 : 1) : 0;
  return first < second === (better === "less") ? -1 : 1;
}

const kStart = "start";

/** The one that is held, of the one that is picked: { name, values, detail }; nothing if there is none. */
function held_one(report, candidates, held, picked) {
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
  const name = `${heading(report, picked)} as drawn`;
  return {
    name,
    values: { ...ascent.start.metrics, end_value: ascent.start_value },
    detail: ascent.start,
  };
}

function comparison(report, candidates, held, picked) {
  const one = held.values;
  const other = values_of(report, candidates, picked);
  const cell = (metric, values, is_better) =>
    h(
      "td",
      is_better ? { class: "better", title: "The better of the two" } : {},
      with_unit(metric, values[metric.name]),
    );
  const lines = metrics
    .filter(({ name }) => one[name] !== undefined && other[name] !== undefined)
    .map((metric) => {
      const which = which_is_better(metric, one[metric.name], other[metric.name]);
      return h(
        "tr",
        { "data-metric": metric.name },
        h("th", { scope: "row", title: metric.about }, metric.label),
        cell(metric, one, which < 0),
        cell(metric, other, which > 0),
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
      one =
        held !== "" && held !== picked && picked !== null
          ? held_one(this.#report, this.#candidates, held, picked)
          : null;
    by_id("hold").hidden = held === picked;
    by_id("hold-start").hidden =
      held === kStart || !held_one(this.#report, this.#candidates, kStart, picked);
    by_id("release").hidden = held === "";
    by_id("beside-words").textContent =
      held === ""
        ? "Hold this one, and pick another: their numbers and their diagonals stand side by side."
        : one
          ? "In bold the better of each two."
          : held === kStart
            ? "The draw that a sheet was made of is held. Pick one with all details."
            : `${heading(this.#report, held)} is held. Pick another one.`;
    by_id("beside").replaceChildren(
      ...(one ? [comparison(this.#report, this.#candidates, one, picked)] : []),
    );
    this.#show_histories(one);
  }

  #show_histories(one) {
    const report = this.#report,
      detail = one?.detail;
    by_id("beside-figure").hidden = !detail;
    this.#histories = null;
    if (!detail) {
      by_id("beside-histories").replaceChildren();
      return;
    }
    const decoded = decode_lengths(detail, report);
    by_id("beside-title").textContent = `Lengths of the diagonals of ${one.name.toLowerCase()}`;
    const along = { state: this.#held_state, detail, decoded, end_deg: end_of_path(report) };
    this.#histories = { decoded, chart: make_histories(h("p"), report, along) };
    this.#follow();
    this.#redraw ??= show_when_wide(by_id("beside-histories"), (width) =>
      this.#histories ? this.#histories.chart.draw(width) : h("span"),
    );
    this.#redraw();
  }

  // At the same pilot angle as the picked one.
  #follow() {
    const pilot_deg = this.#state.get("pilot_deg");
    if (!this.#histories || pilot_deg === null) return;
    this.#held_state.set("sample", last_sample_up_to(this.#histories.decoded.pilot_deg, pilot_deg));
    this.#histories.chart.move();
  }
}

export const make_beside = (report, candidates, state) => new Beside(report, candidates, state);
