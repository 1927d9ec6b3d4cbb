// Crease patterns in a browser: their size on the page in millimetres, and every line against the
// FOLD file of the same draw.
//   node svg_test.mjs [--wrong] FILE.svg FILE.fold ...
// What comes behind --wrong must not be as its FOLD file says.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open_browser } from "./browser.mjs";

/** The browser's layout: a CSS pixel is 1/96 inch. */
const measured = () => {
  const mm = 25.4 / 96;
  const corner = document.documentElement.getBoundingClientRect();
  const on_page = (path) => {
    const to_page = path.getScreenCTM(),
      points = [];
    const numbers = path
      .getAttribute("d")
      .match(/-?[\d.]+/g)
      .map(Number);
    for (let k = 0; k < numbers.length; k += 2) {
      const p = new DOMPoint(numbers[k], numbers[k + 1]).matrixTransform(to_page);
      points.push([(p.x - corner.left) * mm, (p.y - corner.top) * mm]);
    }
    return {
      points,
      closed: /Z\s*$/.test(path.getAttribute("d")),
      length_mm: path.getTotalLength() * to_page.a * mm,
    };
  };
  const layers = {};
  for (const layer of document.querySelectorAll("g")) {
    layers[layer.id] = {
      stroke: getComputedStyle(layer).stroke,
      mode: layer.getAttribute("inkscape:groupmode"),
      paths: [...layer.querySelectorAll("path")].map(on_page),
    };
  }
  const hidden = {};
  for (const id of ["springs", "labels"]) {
    const layer = document.getElementById(id);
    hidden[id] = layer !== null && getComputedStyle(layer).display === "none";
  }
  const labels = [...document.querySelectorAll("#labels text")].map((text) => ({
    words: text.textContent,
    at: [Number(text.getAttribute("x")), Number(text.getAttribute("y"))],
  }));
  return { hidden, labels, width_mm: corner.width * mm, height_mm: corner.height * mm, layers };
};

// Chromium lays out in 1/64 px: 0.004 mm, at both ends.
const near = (a, b) => Math.abs(a - b) < 0.01;
const meet = (p, q) => near(p[0], q[0]) && near(p[1], q[1]);

/** Returns whether each segment of one list is one of the other, in whatever order and direction. */
function same(ours, theirs) {
  const left = [...theirs];
  for (const [a, b] of ours) {
    const k = left.findIndex(([c, d]) => (meet(a, c) && meet(b, d)) || (meet(a, d) && meet(b, c)));
    if (k < 0) return false;
    left.splice(k, 1);
  }
  return left.length === 0;
}

/** The flat sheet of a FOLD file, and how it lies on the page. */
function sheet_of(fold, seen) {
  const xs = fold.vertices_coords.map((p) => p[0]),
    ys = fold.vertices_coords.map((p) => p[1]);
  const width = Math.max(...xs) - Math.min(...xs),
    height = Math.max(...ys) - Math.min(...ys),
    margin_mm = (seen.width_mm - width) / 2;
  const to_sheet = ([x, y]) => [x - margin_mm + Math.min(...xs), Math.max(...ys) + margin_mm - y];
  return { width, height, margin_mm, to_sheet };
}

function check_lines(check, seen, fold, { to_sheet }) {
  check(seen.layers.mountain?.stroke === "rgb(255, 0, 0)", "mountains are red");
  check(seen.layers.valley?.stroke === "rgb(0, 0, 255)", "valleys are blue");
  check(seen.layers.cut?.stroke === "rgb(0, 0, 0)", "cuts are black");
  check(
    Object.values(seen.layers).every((layer) => layer.mode === "layer"),
    "layers for an editor",
  );
  /** Segments of a layer, and of the file's edges with a letter, as pairs of points of the sheet. */
  const drawn = (layer) =>
    layer.paths.flatMap(({ points, closed }) =>
      (closed ? [...points, points[0]] : points)
        .map(to_sheet)
        .flatMap((p, k, all) => (k ? [[all[k - 1], p]] : [])),
    );
  const ends_of = (edge) => edge.map((v) => fold.vertices_coords[v]);
  for (const [id, letter] of [
    ["mountain", "M"],
    ["valley", "V"],
    ["cut", "B"],
  ]) {
    const edges = fold.edges_vertices.filter((_, e) => fold.edges_assignment[e] === letter);
    check(
      same(drawn(seen.layers[id]), edges.map(ends_of)),
      `${id}: other lines than the ${letter} edges of the FOLD file`,
    );
  }
  check(
    seen.layers.cut.paths.every((path) => path.closed),
    "cuts are closed outlines",
  );
  // One length, as the browser measures the drawn line.
  const [a, b] = ends_of(fold.edges_vertices[fold.edges_assignment.indexOf("M")]);
  const wanted = Math.hypot(a[0] - b[0], a[1] - b[1]);
  check(
    seen.layers.mountain.paths.some((path) => near(path.length_mm, wanted)),
    `no mountain is ${wanted} mm long`,
  );
}

/** A label at each vertex, and the diagonals' numbers of the file, each on its diagonal. */
function check_labels(check, seen, fold, { to_sheet }) {
  // Layers that are not to be cut are there, and hidden.
  for (const id of ["springs", "labels"]) check(seen.hidden[id], `${id} are not hidden`);
  const label_at = new Map(seen.labels.map(({ words, at }) => [words, to_sheet(at)])),
    nowhere = [NaN, NaN];
  const diagonals = fold["misalign:data"].diagonals;
  const vertex_named = (label) => fold.vertices_coords[Number(label.slice(1)) - 1];
  check(
    seen.labels.length === fold.vertices_coords.length + diagonals.length,
    `${seen.labels.length} labels`,
  );
  fold.vertices_coords.forEach((point, v) =>
    check(meet(label_at.get(`A${v + 1}`) ?? nowhere, point), `label A${v + 1} is elsewhere`),
  );
  for (const { diagonal, from, to } of diagonals) {
    const at = label_at.get(String(diagonal)) ?? nowhere,
      [p, q] = [vertex_named(from), vertex_named(to)];
    const [x, y] = [q[0] - p[0], q[1] - p[1]],
      [dx, dy] = [at[0] - p[0], at[1] - p[1]],
      length = Math.hypot(x, y);
    const beside = (x * dy - y * dx) / length,
      along = (x * dx + y * dy) / length ** 2;
    check(
      near(beside, 0) && along > 0 && along < 0.5,
      `number ${diagonal} is not on its diagonal, by its beginning`,
    );
  }
}

/** The errors of a drawing, in words. */
async function failures_of(page, svg_file, fold_file) {
  const fold = JSON.parse(readFileSync(fold_file, "utf8")),
    failures = [],
    check = (good, what) => good || failures.push(what);
  await page.goto(pathToFileURL(resolve(svg_file)).href);
  const seen = await page.evaluate(measured),
    sheet = sheet_of(fold, seen),
    { width, height, margin_mm } = sheet;
  check(margin_mm > 1 && margin_mm < 20, `margin of ${margin_mm} mm`);
  check(near(seen.height_mm - height, 2 * margin_mm), "height and width have other margins");
  check_lines(check, seen, fold, sheet);
  check_labels(check, seen, fold, sheet);
  const size = [seen.width_mm, seen.height_mm, width, height].map((mm) => mm.toFixed(3));
  console.log(
    `${svg_file}: ${size[0]} x ${size[1]} mm on the page, sheet ${size[2]} x ${size[3]}, ${failures.length} failures`,
  );
  return failures;
}

const browser = await open_browser(),
  page = await browser.newPage(),
  words = process.argv.slice(2);
let bad = 0;
while (words.length > 0) {
  const wrong = words[0] === "--wrong" && words.shift(),
    [svg_file, fold_file] = words.splice(0, 2),
    failures = await failures_of(page, svg_file, fold_file);
  const complaints = wrong ? (failures.length ? [] : ["what is wrong goes unseen"]) : failures;
  for (const complaint of complaints) console.error(`${svg_file}: ${complaint}`);
  bad += complaints.length;
}
await browser.close();
process.exit(bad ? 1 : 0);
