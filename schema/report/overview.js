// Shows the overview: the campaign's name, its configuration, and its results.
import { show_acceptance } from "./acceptance.js";
import { show_angles } from "./angles.js";
import { asked } from "./campaign_words.js";
import { by_id } from "./format.js";
import { show_ladder } from "./ladder.js";
import { is_splitting } from "./page_kind.js";

/** Called again whenever the report has changed. */
export function show_overview(report) {
  const { name } = report.campaign;
  document.title = `${name} · misalign ${report.watch ? "watch" : "report"}`;
  by_id("campaign-name").textContent = name;
  by_id("asked").textContent = asked(report);
  if (is_splitting(report)) show_ladder(report);
  else show_acceptance(report);
  show_angles(report);
}
