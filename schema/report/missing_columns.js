// Offers the columns of studies that the page lacks, with the commands that add them.
import { command, report_command } from "./commands.js";
import { h } from "./format.js";
import { metric_of, metrics, of_studies } from "./metrics.js";

export const missing_columns = (candidates) =>
  metrics.filter(({ name }) => of_studies.has(name) && !candidates.columns[name]);

/** Says that the page lacks a column, with the command that adds it. */
export function offer_of(report, name) {
  const { label, about } = metric_of[name];
  const is_empty = name in report.candidates.columns;
  const sentence = is_empty
    ? `No candidate of this page has a value in the column “${name}” (${label}).`
    : `This page lacks the column “${name}” (${label}); the command adds it:`;
  const words = report_command(report, `--column ${name}`);
  return is_empty
    ? h("p", { title: about, "data-testid": `offer-${name}` }, sentence)
    : h("div", { "data-testid": `offer-${name}` }, command(sentence, words, null, about));
}
