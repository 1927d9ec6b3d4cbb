// Invented report data of any size, in the form the program writes, so that the page can be built
// and tried without it. The folding is the exact one of the unshifted Miura-ori; lengths, verdicts
// and faults are made up, but consistent with each other.
//
//   node invented_data.mjs PAGE.html REPORT.html [--candidates 400] [--details 3] [--rows 6] ...
import { readFileSync, writeFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const kPanel_mm = 80,
  kOffset_mm = 40,
  kStiffness = 50;

/** A small seeded generator (mulberry32): the same data in every run. */
function random_source(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

const base64 = (typed) =>
  Buffer.from(typed.buffer, typed.byteOffset, typed.byteLength).toString("base64");
const label = (vertex) => `A${vertex + 1}`;

/** The flat Miura-ori with the checkerboard of its inner panels taken out. */
export function miura_sheet(rows, columns) {
  const vertex = (i, j) => i * (columns + 1) + j;
  const is_hole = (r, c) => r > 0 && c > 0 && r < rows - 1 && c < columns - 1 && (r + c) % 2 === 1;
  const vertices_mm = [];
  for (let i = 0; i <= rows; ++i) {
    for (let j = 0; j <= columns; ++j) {
      const inner = j > 0 && j < columns;
      const x =
        j === columns
          ? kPanel_mm * columns + kOffset_mm
          : kPanel_mm * j + (inner && i % 2 ? kOffset_mm : 0);
      vertices_mm.push([x, kPanel_mm * i]);
    }
  }
  const panels = [],
    holes = [],
    diagonals = [],
    creases = [],
    cuts = [];
  for (let r = 0; r < rows; ++r) {
    for (let c = 0; c < columns; ++c) {
      const corners = [vertex(r, c), vertex(r, c + 1), vertex(r + 1, c + 1), vertex(r + 1, c)];
      if (!is_hole(r, c)) {
        panels.push(corners);
        continue;
      }
      holes.push({ place: [r, c], corners });
      for (const [from, to] of [
        [corners[1], corners[3]],
        [corners[2], corners[0]],
      ]) {
        diagonals.push({
          hole: [r, c],
          from: label(from),
          to: label(to),
          from_vertex: from,
          to_vertex: to,
        });
      }
    }
  }
  const zigzag_sign = (j) => (j % 2 ? 1 : -1);
  const straight_sign = (i, j) =>
    j === 0 ? (i % 2 ? -1 : 1) * zigzag_sign(1) : (i % 2 ? 1 : -1) * zigzag_sign(j);
  const assignment = (sign) => (sign > 0 ? "valley" : "mountain");
  const add = (a, b, f, g, sign) => {
    if (f && g) creases.push({ a, b, assignment: assignment(sign) });
    else if (f || g) cuts.push([a, b]);
  };
  const kept = (r, c) => r >= 0 && c >= 0 && r < rows && c < columns && !is_hole(r, c);
  for (let i = 0; i <= rows; ++i) {
    for (let j = 0; j <= columns; ++j) {
      if (j < columns)
        add(vertex(i, j), vertex(i, j + 1), kept(i, j), kept(i - 1, j), straight_sign(i, j));
      if (i < rows) add(vertex(i, j), vertex(i + 1, j), kept(i, j - 1), kept(i, j), zigzag_sign(j));
    }
  }
  const ball_joints = [];
  for (let i = 1; i < rows; ++i) {
    for (let j = 1; j < columns; ++j) {
      const around = [
        [i - 1, j - 1],
        [i - 1, j],
        [i, j],
        [i, j - 1],
      ].filter(([r, c]) => is_hole(r, c));
      if (around.length === 2) ball_joints.push(vertex(i, j));
    }
  }
  return {
    rows,
    columns,
    vertices_mm,
    panels,
    holes,
    creases,
    cuts,
    ball_joints,
    pilot: [1, columns + 2],
    diagonals,
    zigzag_sign,
    straight_sign,
  };
}

const apply = ({ m, t }, p) =>
  [0, 1, 2].map((k) => m[k][0] * p[0] + m[k][1] * p[1] + m[k][2] * p[2] + t[k]);

/** The pose times a rotation by `angle` about the line from a to b. */
function turned(pose, a, b, angle) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const [x, y] = [(b[0] - a[0]) / length, (b[1] - a[1]) / length];
  const c = Math.cos(angle),
    s = Math.sin(angle);
  const r = [
    [c + x * x * (1 - c), x * y * (1 - c), y * s],
    [x * y * (1 - c), c + y * y * (1 - c), -x * s],
    [-y * s, x * s, c],
  ];
  const moved = [0, 1, 2].map((k) => a[k] - r[k][0] * a[0] - r[k][1] * a[1] - r[k][2] * a[2]);
  return {
    m: pose.m.map((row) =>
      [0, 1, 2].map((k) => row[0] * r[0][k] + row[1] * r[1][k] + row[2] * r[2][k]),
    ),
    t: apply(pose, moved),
  };
}

/** Vertices of the unshifted sheet at a pilot angle, from the poses of its facets. */
export function folded_vertices_mm(sheet, pilot_deg) {
  const { rows, columns } = sheet;
  const at = (i, j) => [...sheet.vertices_mm[i * (columns + 1) + j], 0];
  const zigzag = (pilot_deg * Math.PI) / 180;
  const straight =
    2 * Math.atan((kOffset_mm / Math.hypot(kPanel_mm, kOffset_mm)) * Math.tan(zigzag / 2));
  const positions = new Array(sheet.vertices_mm.length);
  let left = {
    m: [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
    t: [0, 0, 0],
  };
  for (let c = 0; c < columns; ++c) {
    if (c > 0) left = turned(left, at(0, c), at(1, c), -sheet.zigzag_sign(c) * zigzag);
    let pose = left;
    for (let r = 0; r < rows; ++r) {
      // Going up, the facet left behind lies right of the crease (r, c) -> (r, c + 1).
      if (r > 0) pose = turned(pose, at(r, c), at(r, c + 1), sheet.straight_sign(r, c) * straight);
      for (const [i, j] of [
        [r, c],
        [r, c + 1],
        [r + 1, c],
        [r + 1, c + 1],
      ]) {
        positions[i * (columns + 1) + j] ??= apply(pose, at(i, j));
      }
    }
  }
  return positions;
}

function candidate_columns(count, random) {
  const columns = { draw: [] };
  const put = (name, value) => (columns[name] ??= []).push(value);
  const two_sided = () => random() + random() - 1;
  let draw = 9007199254740000n; // beyond 2^53 before long: numbers would lose digits
  for (let i = 0; i < count; ++i) {
    draw += 1n + BigInt(Math.floor(random() * 4000));
    columns.draw.push(String(i < 5 ? 1000 * i + 7 : draw));
    const depth = Math.min(180, 170 + Math.floor(-2.2 * Math.log(random())));
    put("deploys_from_deg", depth);
    put("fold_limit_deg", Math.min(180, depth + 3 * random()));
    const slope = 0.0002 + 0.012 * random() ** 3;
    put("slope_min_mm_per_deg", i % 97 === 5 ? null : slope);
    put(
      "slope_between_min_mm_per_deg",
      i % 97 === 5 ? null : slope * (0.9 - (i % 211 === 3 ? 1.2 : 0)),
    );
    put("bump_deg", i % 211 === 3 ? 10 + Math.floor(random() * 150) : null);
    const stroke_max = 0.04 + 0.03 * random() + 0.02 * two_sided();
    put("stroke_min", 0.001 + slope * 1.5 * (0.5 + random()));
    put("stroke_max", stroke_max);
    put("elongation_min", -stroke_max);
    put("elongation_max", stroke_max * (0.4 + 0.5 * random()));
    put("stretch_sq_mm2", 40 + 9e4 * stroke_max ** 2 * (0.5 + random()));
    put("shifted_vertices", 9 + Math.floor(16 * random()));
    const increasing = 3 + Math.floor(10 * random());
    put("increasing", increasing);
    put("decreasing", 16 - increasing);
    put("kawasaki_defect_deg", 0.2 + 0.6 * random());
    put("singular_value_min", 10 ** (-4 + random()));
    put("residual_max", 10 ** (-14 + 1.5 * random()));
    put("isometry_error_mm", 10 ** (-13 + random()));
  }
  // Best first, as the program orders them.
  const order = columns.draw
    .map((_, i) => i)
    .sort(
      (a, b) =>
        columns.deploys_from_deg[b] - columns.deploys_from_deg[a] ||
        (columns.slope_min_mm_per_deg[b] ?? -1) - (columns.slope_min_mm_per_deg[a] ?? -1),
    );
  return Object.fromEntries(
    Object.entries(columns).map(([name, values]) => [name, order.map((i) => values[i])]),
  );
}

function invented_detail(sheet, draw, metrics, random, stroke_limit) {
  const depth_deg = metrics.deploys_from_deg;
  const last_deg = Math.min(180, Math.max(depth_deg + 2, Math.floor(metrics.fold_limit_deg)));
  const pilot_deg = Array.from({ length: last_deg + 1 }, (_, k) => k);
  const n = pilot_deg.length,
    diagonals = sheet.diagonals;
  const flat_mm = diagonals.map(({ from_vertex: a, to_vertex: b }) =>
    Math.hypot(
      sheet.vertices_mm[a][0] - sheet.vertices_mm[b][0],
      sheet.vertices_mm[a][1] - sheet.vertices_mm[b][1],
    ),
  );
  const most = diagonals.map(
    (_, d) => (random() < 0.5 ? 1 : -1) * (d ? 0.1 + 0.9 * random() : 1) * metrics.stroke_max,
  );
  const power = diagonals.map(() => 1.3 + random());
  const length_mm = new Float32Array(n * diagonals.length),
    vertices = new Int16Array(n * sheet.vertices_mm.length * 3);
  const unit_mm = Math.max(0.01, Math.hypot(...sheet.vertices_mm.at(-1)) / 32000); // folded, it is nowhere longer
  const energy = new Float32Array(n),
    moment = new Float32Array(n),
    advantage = new Float32Array(n);
  pilot_deg.forEach((angle, k) => {
    diagonals.forEach((_, d) => {
      const share = (angle / depth_deg) ** power[d];
      const back = d === 2 && angle > depth_deg ? 0.004 * (angle - depth_deg) : 0;
      length_mm[k * diagonals.length + d] =
        flat_mm[d] * (1 + most[d] * share - Math.sign(most[d]) * back);
      energy[k] += 0.5 * kStiffness * (flat_mm[d] * most[d] * share) ** 2;
    });
    folded_vertices_mm(sheet, angle)
      .flat()
      .forEach(
        (x, i) => (vertices[k * sheet.vertices_mm.length * 3 + i] = Math.round(x / unit_mm)),
      );
    advantage[k] = k ? 0.02 + 0.3 * (angle / 180) ** 2 : NaN;
  });
  for (let k = 1; k < n; ++k)
    moment[k] =
      ((energy[Math.min(n - 1, k + 1)] - energy[k - 1]) / (Math.min(n - 1, k + 1) - k + 1)) *
      (180 / Math.PI);
  let weakest = 5;
  for (let k = 5; k <= depth_deg; ++k) if (moment[k] < moment[weakest]) weakest = k;
  const displacements_mm = {};
  for (let i = 1; i < sheet.rows; ++i) {
    for (let j = 1; j < sheet.columns; ++j) {
      const shift = [0, 0].map(() => 0.4 * Math.floor(3 * random() - 1));
      if (shift[0] || shift[1]) displacements_mm[label(i * (sheet.columns + 1) + j)] = shift;
    }
  }
  const over =
    stroke_limit &&
    pilot_deg.find((_, k) =>
      diagonals.some(
        (__, d) => Math.abs(length_mm[k * diagonals.length + d] / flat_mm[d] - 1) > stroke_limit,
      ),
    );
  return {
    draw,
    accepted: depth_deg >= 170,
    verdict:
      depth_deg >= 180
        ? { deploys_from_deg: 180, first_fault: "none", fault_deg: null, where: null }
        : {
            deploys_from_deg: depth_deg,
            first_fault: "not_monotone",
            fault_deg: depth_deg + 1,
            where: `${diagonals[2].from}-${diagonals[2].to}`,
          },
    fold_limit_deg: metrics.fold_limit_deg,
    metrics: { ...metrics, deploys_from_sample: depth_deg },
    displacements_mm,
    pilot_deg,
    length_mm: base64(length_mm),
    vertices_mm: { unit_mm, data: base64(vertices) },
    energy_n_mm: base64(energy),
    moment_n_mm: base64(moment),
    mechanical_advantage: base64(advantage),
    weakest: { pilot_deg: weakest, moment_n_mm: moment[weakest] },
    few: { diagonals: [0, 3, 7], share: 0.53, proven: true },
    over_stroke:
      over === undefined || over === null
        ? null
        : {
            from_deg: over,
            diagonals: diagonals
              .map((_, d) => d)
              .filter(
                (d) =>
                  Math.abs(length_mm[over * diagonals.length + d] / flat_mm[d] - 1) > stroke_limit,
              ),
          },
  };
}

/** Exact first faults of one draw in 1024: like those of the paper's sheet, invented. */
function invented_faults(sheet, draws, random) {
  const counts = new Map();
  const places = sheet.diagonals.map((d) => `${d.from}-${d.to}`),
    weights = places.map(() => random() ** 2 + 0.05);
  const total = weights.reduce((a, b) => a + b);
  for (let i = 0; i < draws; ++i) {
    const u = random();
    const angle = Math.min(181, Math.ceil(20 - 75 * Math.log(u) * (0.5 + 0.5 * random())));
    const first_fault =
      angle > 180
        ? "none"
        : random() < 0.9 - 0.003 * Math.max(0, angle - 120)
          ? "not_monotone"
          : random() < 0.6
            ? "over_folded"
            : "fold_limit";
    let where = null;
    if (first_fault === "not_monotone") {
      let left = random() * total,
        d = 0;
      while ((left -= weights[d]) > 0) ++d;
      where = places[d];
    } else if (first_fault === "over_folded") {
      const crease = sheet.creases[Math.floor(random() ** 3 * sheet.creases.length)];
      where = `${label(crease.a)}-${label(crease.b)}`;
    }
    const key = JSON.stringify([first_fault, angle > 180 ? null : angle, where, angle > 170]);
    counts.set(key, (counts.get(key) ?? 0) + 1);
  }
  return [...counts].map(([key, draws_]) => {
    const [first_fault, fault_deg, where, accepted] = JSON.parse(key);
    return { first_fault, fault_deg, where, accepted, draws: draws_ };
  });
}

export function invented_report({
  candidates = 400,
  details = 3,
  rows = 6,
  columns = 6,
  sampled = 33000,
  stroke_limit = 0.05,
  seed = 1,
} = {}) {
  const random = random_source(seed),
    sheet = miura_sheet(rows, columns);
  const table = candidate_columns(candidates, random);
  const draws = sampled * 1024,
    accepted = Math.max(candidates, Math.round(candidates * 1.5));
  const rate = accepted / draws,
    error = accepted ? 1.96 * Math.sqrt((rate * (1 - rate)) / draws) : 0;
  const made = Array.from({ length: Math.min(details, candidates) }, (_, k) => {
    const i = Math.floor((k * candidates) / (details + 1)); // deep ones and others
    const metrics = Object.fromEntries(
      Object.entries(table).map(([name, values]) => [name, values[i]]),
    );
    delete metrics.draw;
    return invented_detail(sheet, table.draw[i], metrics, random, stroke_limit);
  });
  const { vertices_mm, panels, holes, creases, cuts, ball_joints, pilot } = sheet;
  return {
    format: 1,
    program: { version: "0.1.0", commit: "invented" },
    written_at: "2026-01-01T00:00:00Z",
    catalogue: `results/miura-${rows}x${columns}-1a2b3c4d.db`,
    commands: {
      misalign: "misalign",
      catalogue: `'results/it is invented.db'`,
      output: "report.html",
    },
    campaign: {
      name: `miura-${rows}x${columns}`,
      identity: "1a2b3c4d5e6f708192a3b4c5d6e7f801",
      configuration: {
        name: `miura-${rows}x${columns}`,
        pattern: {
          family: "miura",
          rows,
          columns,
          panel_width_mm: 80,
          panel_height_mm: 80,
          zigzag_offset_mm: 40,
          holes: "checkerboard-odd",
        },
        misalignment: { vertices: "interior", amplitude_mm: 0.4, levels: "ternary" },
        path: { sample_deg: 1, end_deg: 180 },
        accept: { deploys_from_deg: 170, between_samples: false },
        actuators: { stiffness_n_per_mm: kStiffness, stroke_limit },
        seed: 1,
        stop: { draws, accepted: null, relative_error: null, wall_s: null },
      },
    },
    state: {
      draws,
      missing: 0,
      complete: true,
      accepted,
      rejected: draws - accepted,
      undecided: 0,
      acceptance: draws
        ? {
            rate,
            rate_low: Math.max(0, rate - error),
            rate_high: accepted ? rate + error : 3.84 / draws,
            relative_error: accepted ? error / rate : null,
          }
        : { rate: null, rate_low: null, rate_high: null, relative_error: null },
      fault_sample: {},
      draws_per_s: 295000,
      digest: "0f",
    },
    faults: { every: 1024, rows: invented_faults(sheet, sampled, random) },
    sheet: { vertices_mm, panels, holes, creases, cuts, ball_joints, pilot },
    diagonals: sheet.diagonals,
    candidates: { total: accepted, shown: candidates, columns: table },
    actuators: { stiffness_n_per_mm: kStiffness, stroke_limit },
    details: made,
  };
}

/** What the program does: the data take the placeholder's place, every `<` escaped. */
export function put_into_page(page, data) {
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  const [before, after, ...more] = page.split("@REPORT_DATA@");
  if (after === undefined || more.length)
    throw new Error("the page must have exactly one @REPORT_DATA@");
  return before + json + after;
}

if (import.meta.url === pathToFileURL(process.argv[1] ?? "").href) {
  const [page, output, ...options] = process.argv.slice(2);
  const chosen = {};
  for (let i = 0; i < options.length; i += 2) chosen[options[i].slice(2)] = Number(options[i + 1]);
  writeFileSync(output, put_into_page(readFileSync(page, "utf8"), invented_report(chosen)));
}
