// Offers the columns of studies that the page lacks, with the commands that add them.
import { copy_button, unbroken } from "./copying.js";
import { h } from "./format.js";
import { metric_of, metrics, of_studies } from "./metrics.js";

export const missing_columns = (candidates) =>
  metrics.filter(({ name }) => of_studies.has(name) && !candidates.columns[name]);

function column_command({ commands }, name) {
  const { misalign, catalogue, choice, springs, output } = commands;
  return `${misalign} report ${catalogue}${choice} --column ${name}${springs} --output ${output}`;
}

/** Says that the page lacks a column, with the command that adds it. */
export function offer_of(report, name) {
  const { label, about } = metric_of[name];
  const is_empty = name in report.candidates.columns;
  const sentence = is_empty
    ? `No candidate of this page has a value in the column “${name}” (${label}).`
    : `This page lacks the column “${name}” (${label}); the command adds it:`;
  const text = column_command(report, name);
  return h(
    "div",
    { class: "command", "data-testid": `offer-${name}` },
    h("p", { title: about }, sentence),
    is_empty ? null : h("div", { class: "row" }, h("code", {}, unbroken(text)), copy_button(text)),
  );
}
