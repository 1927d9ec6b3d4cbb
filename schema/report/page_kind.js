// Names and headings that differ between pages of plain searches, splitting searches and pattern
// files.
import { by_id, degrees, plural } from "./format.js";

/** Returns whether the page shows a pattern file, without a campaign. */
export const is_pattern = (report) => Boolean(report.pattern);

/** Returns whether the search was by splitting: its sheets have numbers, and are not draws. */
export const is_splitting = (report) => Boolean(report.state?.ladder);

/** The name of a numbered thing. */
export const noun = (report) => (is_splitting(report) ? "sheet" : "draw");
export const noun_first = (report) => (is_splitting(report) ? "Sheet" : "Draw");

/** "Draw 7", "Sheet 30000049626", or the pattern's name. */
export const heading = (report, draw) =>
  is_pattern(report) ? report.pattern.name : `${noun_first(report)} ${draw}`;

/** Names a sheet's population; nothing for draws. */
export const population_words = (report, draw) =>
  is_splitting(report)
    ? ` Met by population ${BigInt(draw) / BigInt(report.state.ladder.numbers_of_population)}.`
    : "";

/** Beginning of the names of saved files. */
export const file_stem = (report, draw) =>
  is_pattern(report) ? report.pattern.name : `${report.campaign.name}-${draw}`;

/** The angle at which paths end, degrees. */
export const end_of_path = (report) =>
  is_pattern(report) ? report.pattern.sampling.end_deg : report.campaign.configuration.path.end_deg;

/** Describes the sheet instead of a campaign. */
export function show_pattern(report) {
  const { name, sampling } = report.pattern,
    { panels, holes, creases, ball_joints } = report.sheet,
    shifts = Object.keys(report.details[0].displacements_mm).length;
  const exactly = sampling.between_samples === "exact" ? "exactly" : "approximately";
  document.querySelector("#overview .eyebrow").textContent = "Pattern";
  document.querySelector('nav a[href="#overview"]').textContent = "Pattern";
  by_id("campaign-name").textContent = name;
  by_id("asked").textContent =
    `${plural(panels.length, "panel")}, ${plural(holes.length, "hole")}, ${plural(creases.length, "crease")} and ${plural(ball_joints.length, "ball joint")}; ` +
    `${shifts ? `${plural(shifts, "vertex", "vertices")} shifted` : "no vertex is shifted"}. ` +
    `Path from flat, with samples every ${degrees(sampling.sample_deg)} up to ${degrees(sampling.end_deg)}` +
    `${sampling.between_samples ? `, and ${exactly} measured between them` : ""}. One sheet without a campaign.`;
  let past_words = false;
  for (const part of by_id("overview").children) {
    if (past_words) part.hidden = true;
    past_words ||= part.id === "asked";
  }
  by_id("candidates").hidden = true;
  document.querySelector('nav a[href="#candidates"]').hidden = true;
  const skip = document.querySelector("a.skip");
  skip.href = "#inspect";
  skip.textContent = "Skip to the histories";
  document.title = `${name} · misalign`;
}
