// The field above the table: parses conditions as they are typed, and shows their errors.
import { parse_filter } from "./filter.js";
import { count, h, plural } from "./format.js";
import { metrics } from "./metrics.js";
import { offer_of } from "./missing_columns.js";

const kExamples = [
  "stroke_max < 5%",
  "deploys_from_deg >= 172",
  "150 <= deploys_from_deg < 175",
  "slope_between_min_mm_per_deg > 0",
  "bump_deg = none",
  "increasing >= 6",
  "details",
];

function help(insert) {
  const example = (text) => [
    h("button", { type: "button", class: "code", onclick: () => insert(text) }, text),
    " ",
  ];
  const entries = [
    ["draw", "", "Number of the draw or sheet."],
    ...metrics.map(({ name, label, about }) => [name, label, about]),
  ];
  return [
    h(
      "p",
      {},
      "All conditions must hold. A condition is a name, a comparison (< <= > >= = !=) and a number or percentage. ",
      "Examples: ",
      kExamples.flatMap(example),
    ),
    h(
      "dl",
      { class: "columns" },
      entries.map(([name, label, about]) =>
        h(
          "div",
          {},
          h("dt", {}, h("code", {}, name), label ? ` ${label}` : ""),
          h("dd", {}, about),
        ),
      ),
    ),
  ];
}

/** State "filter" is the text; a text with errors leaves the table as it is. */
export function make_filter_field(report, candidates, table, state) {
  const field = document.getElementById("filter"),
    says = document.getElementById("filter-says");
  const read = (typed) => {
    const text = typed.trim(),
      parsed = parse_filter(text, candidates);
    if (field.value.trim() !== text) field.value = typed;
    field.setAttribute("aria-invalid", String(parsed.error !== undefined));
    if (parsed.error !== undefined) {
      says.replaceChildren(
        parsed.error,
        ...(parsed.offers ?? []).map((name) => offer_of(report, name)),
      );
      says.className = "error";
      return; // the table stays as it was
    }
    table.filter(text ? parsed.holds : null);
  };
  const insert = (text) => {
    state.set("filter", `${field.value.trim()} ${text}`.trim());
    field.focus();
  };
  field.addEventListener("input", () => state.set("filter", field.value));
  document.getElementById("filter-clear").addEventListener("click", () => {
    state.set("filter", "");
    field.focus();
  });
  document.getElementById("filter-help").append(...help(insert));
  state.on("filter", read);
  state.on("order", (order) => {
    if (field.getAttribute("aria-invalid") === "true") return; // the error stays
    says.className = "";
    says.textContent =
      order.length === candidates.count
        ? plural(candidates.count, "candidate")
        : `${count(order.length)} of ${plural(candidates.count, "candidate")}`;
  });
  read(state.get("filter"));
}
