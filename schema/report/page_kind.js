// Differences between the pages of a plain search, of a splitting one, and of a single pattern
// file: names, headings, the overview.
import { by_id, degrees, plural } from "./format.js";

/** Whether the page is about a pattern file: no campaign, nothing to choose. */
export const is_pattern = (report) => Boolean(report.pattern);

/** Whether populations were searched: their sheets have numbers, and are no draws. */
export const is_splitting = (report) => Boolean(report.state?.ladder);

/** What one is that has a number. */
export const noun = (report) => (is_splitting(report) ? "sheet" : "draw");
export const noun_first = (report) => (is_splitting(report) ? "Sheet" : "Draw");

/** "Draw 7", "Sheet 30000049626", or the pattern's name. */
export const heading = (report, draw) =>
  is_pattern(report) ? report.pattern.name : `${noun_first(report)} ${draw}`;

/** Of which population a sheet is; nothing of draws. */
export const population_words = (report, draw) =>
  is_splitting(report)
    ? ` Met by population ${BigInt(draw) / BigInt(report.state.ladder.numbers_of_population)}.`
    : "";

/** What names of saved files begin with. */
export const file_stem = (report, draw) =>
  is_pattern(report) ? report.pattern.name : `${report.campaign.name}-${draw}`;

/** Where paths end, degrees. */
export const end_of_path = (report) =>
  is_pattern(report) ? report.pattern.sampling.end_deg : report.campaign.configuration.path.end_deg;

/** In the place of what a campaign asked and found: which sheet this is. */
export function show_pattern(report) {
  const { name, sampling } = report.pattern,
    { panels, holes, creases, ball_joints } = report.sheet,
    shifts = Object.keys(report.details[0].displacements_mm).length;
  const exactly = sampling.between_samples === "exact" ? "exactly " : "";
  document.querySelector("#overview .eyebrow").textContent = "Pattern";
  by_id("campaign-name").textContent = name;
  by_id("asked").textContent =
    `${plural(panels.length, "panel")}, ${plural(holes.length, "hole")}, ${plural(creases.length, "crease")} and ${plural(ball_joints.length, "ball joint")}; ` +
    `${shifts ? `${plural(shifts, "vertex", "vertices")} shifted` : "no vertex is shifted"}. ` +
    `Followed from flat on, with samples every ${degrees(sampling.sample_deg)} up to ${degrees(sampling.end_deg)}` +
    `${sampling.between_samples ? `, and looked at ${exactly}between them` : ""}. One sheet, of no campaign.`;
  let past_words = false;
  for (const part of by_id("overview").children) {
    if (past_words) part.hidden = true;
    past_words ||= part.id === "asked";
  }
  by_id("candidates").hidden = true;
  document.querySelector('nav a[href="#candidates"]').hidden = true;
  const skip = document.querySelector("a.skip");
  skip.href = "#inspect";
  skip.textContent = "Skip to the folding";
  document.title = `${name} · misalign`;
}

/** The formats of `misalign export`, and what each holds. */
export const kExports = {
  json: "Pattern, verdict, metrics and springs as JSON:",
  csv: "Histories of the diagonals as CSV:",
  svg: "Crease pattern at true scale as SVG, in layers for a cutter:",
  fold: "Crease pattern and folded states as FOLD, for Origami Simulator and the like:",
};

/** What can be done with a pattern file: [a sentence, the command, the name it is tested by]. */
export function pattern_commands({ commands, details }) {
  const { misalign, catalogue, springs } = commands;
  const verb = (name, more = "") => `${misalign} ${name} ${catalogue}${more}`,
    exports = Object.entries(kExports).map(([format, about]) => [
      about,
      verb("export", ` --format ${format}${springs} --output exported`),
      format === "fold" ? "command-folded" : `command-${format}`, // fold is also a verb
    ]),
    miscut = [
      "How many copies, cut up to 0.05 mm off, still deploy (with --vertices also: which vertices matter most):",
      verb("tolerance", " --amplitude 0.05"),
      "command-tolerance",
    ];
  return [
    ["The path of this sheet again, degree by degree:", verb("fold"), "command-fold"],
    [
      "Its path by two solvers, and its folded shapes by their coordinates:",
      verb("verify"),
      "command-verify",
    ],
    ...exports,
    ["Springs on its diagonals, in numbers:", verb("actuators", springs), "command-actuators"],
    ...(details[0].verdict.deploys_from_deg > 0 ? [miscut] : []),
  ];
}
