// Crease patterns folded along a tree of faces by another program, Rabbit Ear's
// makeVerticesCoordsFolded, beside the frames of the same file.
//   node refold_test.mjs [--apart] FILE.fold...
// Every vertex of every frame must come out where the frame has it, to 1e-6 mm, both laid with the
// first face in one place; with --apart some vertex must not, by more than 1 mm.
import ear from "rabbit-ear";
import { readFileSync } from "node:fs";

const most_mm = 1e-6,
  apart_mm = 1;

const minus = (a, b) => a.map((x, i) => x - b[i]);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => a.map((x) => x / Math.sqrt(dot(a, a)));

/** Points as seen from the first face's first corner, its first edge and its normal. */
function seen_from_first_face(points, faces) {
  const [a, b, c] = faces[0].map((v) => points[v]);
  const along = unit(minus(b, a)),
    up = unit(cross(along, minus(c, a)));
  return points.map((p) => [along, cross(up, along), up].map((axis) => dot(minus(p, a), axis)));
}

/** The farthest that a vertex comes out from where a frame has it. */
function off_mm({ file_frames, ...key }, frame) {
  const folded = ear.graph.makeVerticesCoordsFolded(
    { ...key, edges_foldAngle: frame.edges_foldAngle },
    [0],
  );
  const one = seen_from_first_face(folded, key.faces_vertices);
  const other = seen_from_first_face(frame.vertices_coords, key.faces_vertices);
  return Math.max(...one.map((p, v) => Math.sqrt(dot(minus(p, other[v]), minus(p, other[v])))));
}

const apart = process.argv[2] === "--apart";
const files = process.argv.slice(apart ? 3 : 2);
let failures = files.length === 0 ? 1 : 0,
  worst_mm = 0;
for (const file of files) {
  const fold = JSON.parse(readFileSync(file, "utf8"));
  const off = fold.file_frames.map((frame) => off_mm(fold, frame));
  const most = Math.max(...off);
  worst_mm = Math.max(worst_mm, most);
  if (apart ? most > apart_mm : most <= most_mm) continue;
  console.error(`${file}: Rabbit Ear is ${most} mm off`);
  ++failures;
}
console.log(
  `${files.length} files refolded, at most ${worst_mm.toPrecision(3)} mm off, ${failures} failures`,
);
process.exit(failures ? 1 : 0);
