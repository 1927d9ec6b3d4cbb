// Shows the selected draw's metrics and verdict.
import { command, report_command } from "./commands.js";
import { copy_button } from "./copying.js";
import { ends_of } from "./data.js";
import { certified, count, dashed, degrees, fixed, h, percent, plural } from "./format.js";
import { metrics, with_unit } from "./metrics.js";
import { save_text } from "./save.js";
import { is_pattern, noun } from "./page_kind.js";
import { fault_words } from "./words.js";

/** Offers a draw's missing details: a button where a program serves the page, else the command. */
export function show_no_details(box, report, draw, compute) {
  const lacks = `This page has the metrics of this ${noun(report)}, but not its folding.`;
  if (report.watch) {
    const words = h("p", { role: "status", "data-testid": "compute-says" }, lacks);
    const button = h("button", { type: "button", "data-testid": "compute" }, "Compute its folding");
    button.addEventListener("click", async () => {
      button.disabled = true;
      words.textContent = "Computing …";
      words.textContent = (await compute(draw)) ?? "";
      button.disabled = false;
    });
    box.replaceChildren(words, h("div", { class: "row" }, button));
    return;
  }
  box.replaceChildren(
    command(
      `${lacks} To add its crease pattern, folding, histories and actuation, write the report again:`,
      report_command(report, `--draw ${draw}`),
      "command-report",
    ),
  );
}

/** The verdict as a sentence. */
export function verdict_words({ verdict, accepted, fold_limit_deg }) {
  const from =
    verdict.deploys_from_deg > 0
      ? `Deploys from ${degrees(verdict.deploys_from_deg)}: up to this angle every diagonal is monotone.`
      : "Does not deploy from any angle.";
  const fault =
    verdict.first_fault === "none"
      ? "No fault up to the end of the path."
      : `First fault${verdict.fault_deg === null ? "" : ` at ${degrees(verdict.fault_deg)}`}: ${fault_words(verdict.first_fault)}${verdict.where ? ` (${dashed(verdict.where)})` : ""}.`;
  return (
    `${accepted === null ? "" : accepted ? "Accepted. " : "Not accepted. "}${from} ${fault}` +
    (fold_limit_deg !== null && fold_limit_deg !== undefined && fold_limit_deg < 180
      ? ` The pilot reaches its fold limit at ${degrees(fold_limit_deg)}.`
      : "")
  );
}

/** The share of a column's values below `value`; equal ones count half. */
function share_below(column, value) {
  let below = 0,
    equal = 0,
    all = 0;
  for (const other of column) {
    if (other === null) continue;
    ++all;
    if (other < value) ++below;
    else if (other === value) ++equal;
  }
  return all > 1 ? (below + equal / 2) / all : null;
}

function place_among(column, value) {
  const share = column && value !== null ? share_below(column, value) : null;
  return share === null
    ? h("i", { class: "place none" })
    : h("i", {
        class: "place",
        style: `--at: ${(100 * share).toFixed(1)}%`,
        role: "img",
        "aria-label": `larger than ${Math.round(100 * share)} % of the candidates`,
        title: `larger than ${Math.round(100 * share)} % of the candidates in the table`,
      });
}

export function show_metrics(box, values, candidates, report) {
  if (!values) {
    box.replaceChildren(
      h(
        "p",
        { class: "note" },
        "No metrics: they are measured up to D, and this sheet does not deploy from any angle.",
      ),
    );
    return;
  }
  box.replaceChildren(
    h(
      "dl",
      { class: candidates.count > 1 ? "metrics" : "metrics alone" },
      metrics
        .filter((metric) => values[metric.name] !== undefined)
        .filter((metric) => !(metric.of_campaign && is_pattern(report)))
        .map((metric) =>
          h(
            "div",
            { title: metric.about },
            h("dt", {}, metric.label),
            h(
              "dd",
              {},
              h("span", {}, with_unit(metric, values[metric.name])),
              place_among(candidates.columns[metric.name], values[metric.name] ?? null),
            ),
          ),
        ),
    ),
    candidates.count > 1
      ? h(
          "p",
          { class: "note" },
          `Scales: rank of this ${noun(report)} among the candidates in the table, the least value on the left.`,
        )
      : "",
  );
}

/** Shows the yields of `misalign tolerance`, one for each amplitude. */
export function show_yields(box, report, draw) {
  const tried = (report.yields ?? []).filter((entry) => entry.draw === draw);
  const words = ({ amplitude_mm, from_deg, trials, survivors, undecided, share_low, share_high }) =>
    `At ±${amplitude_mm} mm ${count(survivors)} of ${plural(trials, "miscut copy", "miscut copies")} still deploy from ${degrees(from_deg)} ` +
    `(95 %: ${percent(share_low)} – ${percent(share_high)})` +
    (undecided ? `; ${count(undecided)} undecided.` : ".");
  box.hidden = tried.length === 0;
  box.replaceChildren(...tried.map((entry) => h("p", {}, words(entry))));
}

/** Shows the certificate of `misalign certify`. */
export function show_certificate(box, report, draw) {
  const found = (report.certificates ?? []).find((entry) => entry.draw === draw);
  box.hidden = !found;
  if (!found) return box.replaceChildren();
  const { certified_deg, end, where, contact, intervals } = found;
  const parts = [
    where ? `${end} at ${dashed(where)}` : end,
    plural(intervals, "interval"),
    ...(contact ? ["no contact of panels"] : []),
  ];
  box.replaceChildren(h("p", {}, `Certified to ${certified(certified_deg)} (${parts.join(", ")})`));
}

export function show_shifts(box, detail) {
  const entries = Object.entries(detail.displacements_mm).sort(
      ([a], [b]) => ends_of(a)[0] - ends_of(b)[0],
    ),
    json = JSON.stringify({ displacements_mm: detail.displacements_mm }, null, 1);
  const save = h("button", { type: "button" }, "Save as JSON");
  const name = `${detail.accepted === null ? "" : "draw-"}${detail.draw}-displacements.json`;
  save.addEventListener("click", () => save_text(json, "application/json", name));
  const signed = (value) =>
    (value > 0 ? `+${fixed(value, 3)}` : fixed(value, 3)).replace(/\.?0+$/, "").replace(/^$/, "0");
  box.replaceChildren(
    h(
      "p",
      { class: "note" },
      `${plural(entries.length, "shifted vertex", "shifted vertices")}. Shifts in mm, x to the right, y up.`,
    ),
    h(
      "ul",
      { class: "shifts" },
      entries.map(([vertex, [x, y]]) =>
        h("li", {}, h("b", {}, vertex), ` (${signed(x)}, ${signed(y)})`),
      ),
    ),
    h("div", { class: "row" }, save, copy_button(json, "Copy as JSON")),
  );
}
