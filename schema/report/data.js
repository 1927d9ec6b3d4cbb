// The report's data as the program wrote them, and a picked draw's histories decoded.

function bytes_of(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes.buffer;
}

const floats = (base64) => new Float32Array(bytes_of(base64));

/** The report of this page; throws in words where there is none, or one of another format. */
export function read_report() {
  let report;
  try {
    report = JSON.parse(document.getElementById("report-data").textContent);
  } catch {
    throw new Error("This page holds no data: it is written by “misalign report CATALOGUE”.");
  }
  if (report.format !== 1) {
    throw new Error(
      `This page reads reports of format 1, and this one has format ${report.format}.`,
    );
  }
  return report;
}

/**
 * The candidates' table as columns, each with one value a row; `row_of` finds a draw's row. Draws
 * stay strings: they may exceed what a number holds exactly.
 */
export function read_candidates(report) {
  const columns = { ...report.candidates.columns };
  columns.draw ??= [];
  const row_of = new Map(columns.draw.map((draw, row) => [draw, row]));
  const detailed = new Set(report.details.map((detail) => detail.draw));
  return { columns, count: columns.draw.length, row_of, detailed };
}

/** Rotations and shifts that lay each pose on the flat sheet as well as can be: it stays in view. */
function steady(vertices_mm, samples, count) {
  const flat = centred(vertices_mm, 0, count);
  const out = new Float32Array(vertices_mm.length);
  let q = [1, 0, 0, 0];
  for (let k = 0; k < samples; ++k) {
    const points = centred(vertices_mm, k * count * 3, count);
    q = best_rotation(points, flat, q);
    const [w, x, y, z] = q;
    const r = [
      1 - 2 * (y * y + z * z),
      2 * (x * y - w * z),
      2 * (x * z + w * y),
      2 * (x * y + w * z),
      1 - 2 * (x * x + z * z),
      2 * (y * z - w * x),
      2 * (x * z - w * y),
      2 * (y * z + w * x),
      1 - 2 * (x * x + y * y),
    ];
    for (let i = 0; i < count * 3; i += 3) {
      for (let row = 0; row < 3; ++row) {
        out[k * count * 3 + i + row] =
          r[3 * row] * points[i] + r[3 * row + 1] * points[i + 1] + r[3 * row + 2] * points[i + 2];
      }
    }
  }
  return out;
}

function centred(values, start, count) {
  const mean = [0, 0, 0];
  for (let i = 0; i < count * 3; ++i) mean[i % 3] += values[start + i] / count;
  return Float64Array.from({ length: count * 3 }, (_, i) => values[start + i] - mean[i % 3]);
}

// Horn's quaternion: the eigenvector of the largest eigenvalue, by power iteration from the last
// pose's, so that the sheet never jumps.
function best_rotation(from, to, start) {
  const s = new Float64Array(9);
  for (let i = 0; i < from.length; i += 3) {
    for (let a = 0; a < 3; ++a) for (let b = 0; b < 3; ++b) s[3 * a + b] += from[i + a] * to[i + b];
  }
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = s;
  const n = [
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, yy - xx - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, zz - xx - yy],
  ];
  const shift = Math.hypot(...n.flat()) || 1;
  let q = start;
  for (let step = 0, change = 1; step < 300 && change > 1e-9; ++step) {
    const next = n.map((row, i) => row.reduce((sum, value, k) => sum + value * q[k], shift * q[i]));
    const length = Math.hypot(...next);
    const turned = next.map((value) => value / length);
    change = Math.hypot(...turned.map((value, i) => value - q[i]));
    q = turned;
  }
  return q;
}

/** A draw's histories: n samples, the first of them flat. */
export function decode_detail(detail, report) {
  const diagonals = report.diagonals.length,
    vertices = report.sheet.vertices_mm.length;
  const samples = detail.pilot_deg.length;
  const length_mm = floats(detail.length_mm);
  const packed = new Int16Array(bytes_of(detail.vertices_mm.data));
  const coordinates = Float64Array.from(packed, (value) => value * detail.vertices_mm.unit_mm);
  const relative = (k, d) => length_mm[k * diagonals + d] / length_mm[d];
  const depth = last_sample_up_to(detail.pilot_deg, detail.verdict.deploys_from_deg);
  return {
    samples,
    depth,
    pilot_deg: detail.pilot_deg,
    deployment: detail.pilot_deg.map((pilot) => (180 - pilot) / 180),
    relative,
    // The direction is that of the range it deploys from: beyond D a diagonal may turn.
    grows: report.diagonals.map(
      (_, d) => relative(Math.max(depth, Math.min(1, samples - 1)), d) >= 1,
    ),
    vertex_count: vertices,
    vertices_mm: steady(coordinates, samples, vertices),
    energy_n_mm: floats(detail.energy_n_mm),
    moment_n_mm: floats(detail.moment_n_mm),
    mechanical_advantage: floats(detail.mechanical_advantage),
  };
}

export function last_sample_up_to(pilot_deg, limit_deg) {
  let k = 0;
  while (k + 1 < pilot_deg.length && pilot_deg[k + 1] <= limit_deg + 1e-9) ++k;
  return k;
}

/** "A17-A23" → the vertices' numbers. */
export const ends_of = (name) => name.split("-").map((label) => Number(label.slice(1)) - 1);
export const label_of = (vertex) => `A${vertex + 1}`;
