// FOLD files by another reader: Rabbit Ear's `validate` on the crease pattern and on every folded
// frame, joined with what it inherits.
//   node fold_test.mjs FILE.fold...
import ear from "rabbit-ear";
import { readFileSync } from "node:fs";

const { validate } = ear.graph;

/** The errors that Rabbit Ear finds in a graph; none if it is valid. */
function complaint(graph) {
  const said = validate(graph);
  // Vertices may meet when the sheet is folded up, never on the flat one.
  const meets =
    graph.frame_classes.includes("creasePattern") && said.vertices.duplicate.flat().length;
  return said.summary === "valid" && !meets ? "" : JSON.stringify(said);
}

/** The frames of a file as graphs of their own. */
function frames(fold) {
  const { file_frames, ...key } = fold;
  return [
    key,
    ...file_frames.map((frame) => {
      if (frame.frame_parent !== 0 || frame.frame_inherit !== true)
        throw new Error("no heir of the key frame");
      return { ...key, ...frame };
    }),
  ];
}

// It must be able to complain: a file that refers to a vertex that is not there, and one with an
// edge twice.
function sees_faults(fold) {
  const [key] = frames(fold);
  const beyond = {
    ...key,
    faces_vertices: [...key.faces_vertices, [0, 1, key.vertices_coords.length]],
  };
  const twice = { ...key, edges_vertices: [...key.edges_vertices, key.edges_vertices[0]] };
  return complaint(beyond) !== "" && complaint(twice) !== "";
}

const files = process.argv.slice(2);
let failures = files.length === 0 ? 1 : 0,
  graphs = 0;
for (const file of files) {
  const fold = JSON.parse(readFileSync(file, "utf8"));
  if (!sees_faults(fold)) {
    console.error(`${file}: Rabbit Ear does not see faults`);
    ++failures;
  }
  for (const graph of frames(fold)) {
    ++graphs;
    const said = complaint(graph);
    if (said) {
      console.error(`${file}: ${graph.frame_title}: ${said}`);
      ++failures;
    }
  }
}
console.log(`${files.length} files, ${graphs} frames, ${failures} failures`);
process.exit(failures ? 1 : 0);
