// Describes a campaign's configuration.
import { degrees, number, plural } from "./format.js";
import { is_splitting } from "./page_kind.js";

// Conditions between two samples.
const kBetween = {
  exact: "; every diagonal must be monotone between samples",
  true: "; every diagonal must be monotone between samples, by cubic interpolation",
};
const kMostNamed = 12; // levels whose angles are all named

const values_of = (value) => (Array.isArray(value) ? value.join(", ") : String(value));

function sheet_words(pattern) {
  const sheet =
    pattern.family === "miura"
      ? `${pattern.rows} × ${pattern.columns} Miura-ori (panels ${values_of(pattern.panel_width_mm)} × ${values_of(pattern.panel_height_mm)} mm, ` +
        `zigzag offset ${values_of(pattern.zigzag_offset_mm)} mm)`
      : `quadrilateral mesh${pattern.file ? ` of ${pattern.file}` : ""}`;
  const holes =
    typeof pattern.holes === "string"
      ? `holes: ${pattern.holes}`
      : Array.isArray(pattern.holes)
        ? plural(pattern.holes.length, "hole")
        : "with holes";
  return `${sheet}; ${holes}`;
}

function shift_words(misalignment) {
  const which =
    misalignment.vertices === "interior"
      ? "all interior vertices"
      : misalignment.vertices === "ring"
        ? "the outer ring of interior vertices"
        : plural(misalignment.vertices.length, "vertex", "vertices");
  const levels =
    misalignment.levels === "ternary"
      ? `−${misalignment.amplitude_mm}, 0 or +${misalignment.amplitude_mm} mm`
      : `a uniform value within ±${misalignment.amplitude_mm} mm`;
  return `${which}, in x and in y, by ${levels}`;
}

function stop_words({ stops_at_deg, stop_stiffness_mm2_per_rad2 }, { stiffness_n_per_mm }) {
  if (!stops_at_deg) return "";
  if (!stiffness_n_per_mm)
    return `, and springs that are relaxed at ${degrees(stops_at_deg)} hold it there`;
  return (
    `, and springs of ${number(stiffness_n_per_mm)} N/mm that are relaxed at ${degrees(stops_at_deg)} hold it there: ` +
    `rotational stiffness at least ${number(stop_stiffness_mm2_per_rad2 * stiffness_n_per_mm)} N mm/rad`
  );
}

/** The requirement of an accepted draw. */
function criterion_words(accept, filling) {
  const to = `from flat to a pilot angle of ${degrees(accept.deploys_from_deg)} or more`;
  if (accept.by !== "energy") return `every diagonal of every hole is monotone ${to}`;
  const { least_friction_n_mm_per_mm: friction, least_moment_n_mm: moment } = accept;
  return (
    `the energy of ${filling}, rises ${to}` +
    (friction ? `, with a critical friction of at least ${number(friction)} N mm/mm` : "") +
    (moment ? `, with a moment of at least ${number(moment)} N mm` : "")
  );
}

/** The levels: named ones, or those of a level finder, which has found `known` of them. */
function level_words(levels_deg, known) {
  if (!Array.isArray(levels_deg))
    return known > 0
      ? `${plural(known, "level")} that a level finder found`
      : "levels that a level finder finds first";
  const [first, last] = [levels_deg[0], levels_deg.at(-1)].map(degrees);
  if (levels_deg.length > kMostNamed)
    return `${plural(levels_deg.length, "named level")} from ${first} to ${last}`;
  return `the named ${levels_deg.length === 1 ? "level" : "levels"} ${levels_deg.map(degrees).join(", ")}`;
}

const search_words = ({ levels_deg, particles, sweeps, first_draws }, known) =>
  ` Searched by splitting: each population begins with ${plural(first_draws, "first draw")} and climbs ${level_words(levels_deg, known)}. ` +
  `At each level the sheets that reach it are copied to ${plural(particles, "particle")}, ` +
  `which random moves within the level separate, in ${plural(sweeps, "sweep")}.`;

const kGoals = {
  critical_friction_n_mm_per_mm: "critical friction",
  miscut_margin_mm: "margin against miscuts",
};

/** The ascents of an optimising search. */
const ascent_words = ({
  method,
  starts,
  starts_of_population,
  maximise,
  subject_to,
  from_deg,
  shifts,
  grid_mm,
}) =>
  method === "optimise"
    ? ` An ascent starts from ${starts === "splitting" ? `each of the first ${plural(starts_of_population, "sheet")} of a population` : "each accepted draw"} and maximises the ${kGoals[maximise] ?? maximise}` +
      `${from_deg === null ? "" : ` from ${degrees(from_deg)}`}${subject_to.length ? `, subject to ${subject_to.join(" and ")}` : ""}. ` +
      `Shifts of the optimum are ${shifts === "ternary" ? "ternary" : grid_mm === null ? "any within the amplitude" : `multiples of ${grid_mm} mm`}. ` +
      "Candidates are the optima."
    : "";

/** The descents of a search among sheets of one shape. */
const shape_words = ({ method, shape_max_mm }, target) =>
  method === "shape"
    ? ` A descent starts from each draw, to a sheet within ${number(shape_max_mm)} mm of its target at ${degrees(target.at_deg)}. Candidates are its ends.`
    : "";

export function asked(report) {
  const { pattern, misalignment, path, accept, search, target } = report.campaign.configuration,
    { between_samples } = accept;
  return (
    `${sheet_words(pattern)}. Each draw shifts ${shift_words(misalignment)}. A draw is accepted when ` +
    `${criterion_words(accept, report.campaign.judged_filling)}${stop_words(accept, report.actuators)}. Samples: every ${degrees(path.sample_deg)} up to ` +
    `${degrees(path.end_deg)}${kBetween[between_samples] ?? ""}.` +
    (is_splitting(report) ? search_words(search, report.state.ladder.levels.length - 1) : "") +
    ascent_words(search) +
    shape_words(search, target)
  );
}
