// A crease pattern in a browser: its size on the page in millimetres, and every line against the
// FOLD file of the same draw.
//   node svg_test.mjs FILE.svg FILE.fold
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open_browser } from "./browser.mjs";

const [svg_file, fold_file] = process.argv.slice(2);
const fold = JSON.parse(readFileSync(fold_file, "utf8"));
const failures = [];
const check = (good, what) => good || failures.push(what);

const browser = await open_browser();
const page = await browser.newPage();
await page.goto(pathToFileURL(resolve(svg_file)).href);
// A CSS pixel is 1/96 inch: what the browser lays out is measured in mm.
const seen = await page.evaluate(() => {
  const mm = 25.4 / 96;
  const corner = document.documentElement.getBoundingClientRect();
  const on_page = (path) => {
    const to_page = path.getScreenCTM(), points = [];
    const numbers = path.getAttribute("d").match(/-?[\d.]+/g).map(Number);
    for (let k = 0; k < numbers.length; k += 2) {
      const p = new DOMPoint(numbers[k], numbers[k + 1]).matrixTransform(to_page);
      points.push([(p.x - corner.left) * mm, (p.y - corner.top) * mm]);
    }
    return { points, closed: /Z\s*$/.test(path.getAttribute("d")), length_mm: path.getTotalLength() * to_page.a * mm };
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
  const labels = [...document.querySelectorAll("#labels text")].map((text) =>
    ({ words: text.textContent, at: [Number(text.getAttribute("x")), Number(text.getAttribute("y"))] }));
  return { hidden, labels, width_mm: corner.width * mm, height_mm: corner.height * mm, layers };
});
await browser.close();

const xs = fold.vertices_coords.map((p) => p[0]), ys = fold.vertices_coords.map((p) => p[1]);
const sheet = { width: Math.max(...xs) - Math.min(...xs), height: Math.max(...ys) - Math.min(...ys) };
// Chromium lays out in 1/64 px: 0.004 mm, at both ends.
const near = (a, b) => Math.abs(a - b) < 0.01;
const margin_mm = (seen.width_mm - sheet.width) / 2;
check(margin_mm > 1 && margin_mm < 20, `margin of ${margin_mm} mm`);
check(near(seen.height_mm - sheet.height, 2 * margin_mm), "height and width have other margins");

check(seen.layers.mountain?.stroke === "rgb(255, 0, 0)", "mountains are red");
check(seen.layers.valley?.stroke === "rgb(0, 0, 255)", "valleys are blue");
check(seen.layers.cut?.stroke === "rgb(0, 0, 0)", "cuts are black");
check(Object.values(seen.layers).every((layer) => layer.mode === "layer"), "layers for an editor");

/** Segments of a layer, and of the file's edges with a letter, as pairs of points of the sheet. */
const to_sheet = ([x, y]) => [x - margin_mm + Math.min(...xs), Math.max(...ys) + margin_mm - y];
const drawn = (layer) => layer.paths.flatMap(({ points, closed }) =>
  (closed ? [...points, points[0]] : points).map(to_sheet).flatMap((p, k, all) => (k ? [[all[k - 1], p]] : [])));
const of_fold = (letter) => fold.edges_vertices.filter((_, e) => fold.edges_assignment[e] === letter)
  .map((edge) => edge.map((v) => fold.vertices_coords[v]));

/** Whether each segment of one list is one of the other, in whatever order and direction. */
function same(ours, theirs) {
  const meet = (p, q) => near(p[0], q[0]) && near(p[1], q[1]);
  const left = [...theirs];
  for (const [a, b] of ours) {
    const k = left.findIndex(([c, d]) => (meet(a, c) && meet(b, d)) || (meet(a, d) && meet(b, c)));
    if (k < 0) return false;
    left.splice(k, 1);
  }
  return left.length === 0;
}
for (const [id, letter] of [["mountain", "M"], ["valley", "V"], ["cut", "B"]]) {
  check(same(drawn(seen.layers[id]), of_fold(letter)), `${id}: other lines than the ${letter} edges of the FOLD file`);
}
check(seen.layers.cut.paths.every((path) => path.closed), "cuts are closed outlines");

// What is not to be cut is there, and hidden.
for (const id of ["springs", "labels"]) {
  check(seen.hidden[id], `${id} are not hidden`);
}
// A label at each vertex, and the diagonals' numbers of the file, each on its diagonal.
const label_at = new Map(seen.labels.map(({ words, at }) => [words, to_sheet(at)]));
const diagonals = fold["misalign:data"].diagonals;
const vertex_named = (label) => fold.vertices_coords[Number(label.slice(1)) - 1];
check(seen.labels.length === fold.vertices_coords.length + diagonals.length, `${seen.labels.length} labels`);
fold.vertices_coords.forEach((point, v) => {
  const at = label_at.get(`A${v + 1}`) ?? [NaN, NaN];
  check(near(at[0], point[0]) && near(at[1], point[1]), `label A${v + 1} is elsewhere`);
});
for (const { diagonal, from, to } of diagonals) {
  const at = label_at.get(String(diagonal)) ?? [NaN, NaN];
  const [p, q] = [vertex_named(from), vertex_named(to)];
  const length = Math.hypot(q[0] - p[0], q[1] - p[1]);
  const beside = ((q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0])) / length;
  const along = ((q[0] - p[0]) * (at[0] - p[0]) + (q[1] - p[1]) * (at[1] - p[1])) / length ** 2;
  check(near(beside, 0) && along > 0 && along < 0.5, `number ${diagonal} is not on its diagonal, by its beginning`);
}

// One length, as the browser measures the drawn line.
const [a, b] = fold.edges_vertices[fold.edges_assignment.indexOf("M")].map((v) => fold.vertices_coords[v]);
const wanted = Math.hypot(a[0] - b[0], a[1] - b[1]);
check(seen.layers.mountain.paths.some((path) => near(path.length_mm, wanted)), `no mountain is ${wanted} mm long`);

for (const failure of failures) console.error(`${svg_file}: ${failure}`);
console.log(`${seen.width_mm.toFixed(3)} x ${seen.height_mm.toFixed(3)} mm on the page, sheet ${sheet.width.toFixed(3)} x ${sheet.height.toFixed(3)}, ${failures.length} failures`);
process.exit(failures.length ? 1 : 0);
