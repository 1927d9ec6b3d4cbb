// A campaign's configuration in words.
import { degrees, number, plural } from "./format.js";
import { is_splitting } from "./page_kind.js";

// What is asked of the way from one sample to the next.
const kBetween = {
  exact: ", and no diagonal may go back between two of these angles either",
  true: ", and no diagonal may go back between two of these angles either, as far as cubics through them tell",
};
const kMostNamed = 12; // levels whose angles are all told

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
      : `anything up to ${misalignment.amplitude_mm} mm either way`;
  return `${which}, in x and in y, by ${levels}`;
}

function stop_words({ stops_at_deg, stop_stiffness_mm2_per_rad2 }, { stiffness_n_per_mm }) {
  if (!stops_at_deg) return "";
  return (
    `, and springs of ${number(stiffness_n_per_mm)} N/mm that are relaxed at ${degrees(stops_at_deg)} hold it there ` +
    `with at least ${number(stop_stiffness_mm2_per_rad2 * stiffness_n_per_mm)} N mm/rad`
  );
}

/** Named levels, or those that a level finder has found (`known`: how many) or will find. */
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
  `At each level the sheets that came there are copied until there are ${plural(particles, "particle")}, ` +
  `and all of them are moved at random within the level, in ${plural(sweeps, "sweep")}.`;

const kGoals = {
  critical_friction_n_mm_per_mm: "it overcomes the most friction",
  miscut_margin_mm: "it has the largest margin against miscuts",
};

/** What becomes of accepted draws, or sheets, in an optimising search. */
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
    ? ` From ${starts === "splitting" ? `the first ${plural(starts_of_population, "sheet")} that each population meets` : "each accepted draw"} it goes on in steps to sheets near it, until ${kGoals[maximise] ?? maximise}` +
      `${from_deg === null ? "" : ` from ${degrees(from_deg)}`}${subject_to.length ? `, with ${subject_to.join(" and ")}` : ""}; ` +
      `ends are shifted ${shifts === "ternary" ? "as draws are" : grid_mm === null ? "freely within the amplitude" : `in steps of ${grid_mm} mm`}. ` +
      "A candidate is the sheet at the end."
    : "";

export function asked(report) {
  const { pattern, misalignment, path, accept, search } = report.campaign.configuration,
    { between_samples } = accept;
  return (
    `${sheet_words(pattern)}. Each draw shifts ${shift_words(misalignment)}. A draw is accepted when every diagonal ` +
    `of every hole only grows or only shrinks from flat to a pilot fold angle of ${degrees(accept.deploys_from_deg)} or more` +
    `${stop_words(accept, report.actuators)}. It is measured every ${degrees(path.sample_deg)} up to ` +
    `${degrees(path.end_deg)}${kBetween[between_samples] ?? ""}.` +
    (is_splitting(report) ? search_words(search, report.state.ladder.levels.length - 1) : "") +
    ascent_words(search)
  );
}
