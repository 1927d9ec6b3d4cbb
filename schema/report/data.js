// Reads the page's data, and decodes a draw's histories.
import { metrics } from "./metrics.js";

function bytes_of(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

export const floats = (base64) => new Float32Array(bytes_of(base64));

/** The report of this page; throws a sentence if there is none, or its format differs. */
export function read_report() {
  let report;
  try {
    report = JSON.parse(document.getElementById("report-data").textContent);
  } catch {
    throw new Error("This page holds no data: “misalign report CATALOGUE” writes one with data.");
  }
  if (report.format !== 1) {
    throw new Error(
      `This page reads reports of format 1, and this one has format ${report.format}.`,
    );
  }
  return report;
}

const kMayBeUnknown = new Set(
  metrics.filter((metric) => metric.may_be_unknown).map(({ name }) => name),
);

/**
 * The candidates' table as columns, without those that have no value; `row_of` maps a draw to its
 * row. Draws stay strings: they may exceed the integers that a number holds exactly.
 */
export function read_candidates(report) {
  const columns = Object.fromEntries(
    Object.entries(report.candidates.columns).filter(
      ([name, values]) => !kMayBeUnknown.has(name) || values.some((value) => value !== null),
    ),
  );
  columns.draw ??= [];
  // The springs' energy at D is no column of the catalogue, which has no stiffness.
  if (report.actuators.equal_springs)
    columns.energy_n_mm = columns.stretch_sq_mm2?.map((sum) =>
      sum === null ? null : (report.actuators.stiffness_n_per_mm / 2) * sum,
    );
  const row_of = new Map(columns.draw.map((draw, row) => [draw, row]));
  const detailed = new Set(report.details.map((detail) => detail.draw));
  return { columns, count: columns.draw.length, row_of, detailed };
}

/** [[time, value]…] of two lists in base64. */
function curve(lists, name) {
  const values = floats(lists[name]);
  return Array.from(floats(lists.time_s), (time, k) => [time, values[k]]);
}

/** A draw's lengths: n samples, the first of them flat. */
export function decode_lengths(detail, report) {
  const diagonals = report.diagonals.length,
    samples = detail.pilot_deg.length,
    length_mm = floats(detail.length_mm),
    relative = (k, d) => length_mm[k * diagonals + d] / length_mm[d],
    depth = last_sample_up_to(detail.pilot_deg, detail.verdict.deploys_from_deg);
  return {
    samples,
    depth,
    pilot_deg: detail.pilot_deg,
    deployment: detail.pilot_deg.map((pilot) => (180 - pilot) / 180),
    flat_mm: length_mm.slice(0, diagonals),
    relative,
    // The direction up to D: beyond it a diagonal may reverse.
    grows: report.diagonals.map(
      (_, d) => relative(Math.max(depth, Math.min(1, samples - 1)), d) >= 1,
    ),
  };
}

/** All histories of a draw. */
export function decode_detail(detail, report) {
  const packed = new Int16Array(bytes_of(detail.vertices_mm.data));
  return {
    ...decode_lengths(detail, report),
    vertex_count: report.sheet.vertices_mm.length,
    vertices_mm: Float32Array.from(packed, (value) => value * detail.vertices_mm.unit_mm),
    energy_n_mm: floats(detail.energy_n_mm),
    force_n: detail.force_n && floats(detail.force_n),
    moment_n_mm: floats(detail.moment_n_mm),
    mechanical_advantage: floats(detail.mechanical_advantage),
    motion: detail.let_go && {
      time_s: floats(detail.let_go.time_s),
      pilot_deg: floats(detail.let_go.pilot_deg),
    },
    stress: detail.stress && {
      motion: curve(detail.stress.motion, "pilot_deg"),
      rigid_motion: curve(detail.stress.rigid_motion, "pilot_deg"),
      history: curve(detail.stress.history, "outside_discs_mpa"),
    },
  };
}

/** The details of a draw, or undefined. */
export const detail_of = (report, draw) => report.details.find((entry) => entry.draw === draw);

/** A draw's values by name: those of its details, and of its row. */
export function values_of(report, candidates, draw) {
  const row = candidates.row_of.get(draw),
    detail = detail_of(report, draw),
    columns = row === undefined ? [] : Object.entries(candidates.columns);
  return {
    ...Object.fromEntries(columns.map(([name, column]) => [name, column[row]])),
    ...detail?.metrics,
  };
}

/** Stops a sheet at a sample, whose angle the address then keeps. */
export function stop_at(state, { pilot_deg }, sample) {
  state.set("playing", false);
  state.set("sample", sample);
  state.set("at", String(pilot_deg[sample]));
}

/** The sample at which a deployment begins: that of the angle of use, of D, or of a rejected draw's end. */
export function first_sample(detail, { depth, samples, pilot_deg }) {
  if (detail.from_deg) return last_sample_up_to(pilot_deg, detail.from_deg);
  return detail.accepted !== false && depth > 0 ? depth : samples - 1;
}

export function last_sample_up_to(pilot_deg, limit_deg) {
  let k = 0;
  while (k + 1 < pilot_deg.length && pilot_deg[k + 1] <= limit_deg + 1e-9) ++k;
  return k;
}

/** "A17-A23" → the vertices' numbers. */
export const ends_of = (name) => name.split("-").map((label) => Number(label.slice(1)) - 1);
export const label_of = (vertex) => `A${vertex + 1}`;
