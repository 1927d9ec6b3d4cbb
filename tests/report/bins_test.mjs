// Numbers of candidates that are counted together, without a browser:
//   node bins_test.mjs SCHEMA/REPORT
// Hexagons are the cells of the points nearest to their centres. A density counts each line once in
// every column that it crosses, where it crosses it.
import assert from "node:assert/strict";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [directory] = process.argv.slice(2);
const load = (name) => import(pathToFileURL(resolve(join(directory, name))).href);
const { hexagons_of, corners_of } = await load("hexagons.js");
const { line_density, quartiles_of } = await load("line_density.js");

const seed = Number(process.env.SEED ?? Date.now() % 1e6);
console.log(`SEED=${seed}`);
let state = seed;
const random = () => {
  state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
  return state / 2 ** 32;
};
const kRows = 3000,
  rows = Array.from({ length: kRows }, (_, row) => row);

function hexagons_check() {
  const radius = 7,
    xs = rows.map(() => 200 * random() - 20),
    ys = rows.map(() => 150 * random() - 20),
    hexagons = hexagons_of(xs, ys, rows, radius);
  const count_of = new Map(
    hexagons.map(({ x, y, count }) => [`${x.toFixed(3)} ${y.toFixed(3)}`, count]),
  );
  assert.equal(count_of.size, hexagons.length, "two hexagons at one place");
  // All centres, without the rule by which the page finds the nearest.
  const centres = [];
  for (let line = -10; line < 20; ++line)
    for (let column = -10; column < 30; ++column)
      centres.push([
        (column + (Math.abs(line) % 2) / 2) * radius * Math.sqrt(3),
        line * 1.5 * radius,
      ]);
  const wanted = new Map();
  for (const row of rows) {
    const away = ([x, y]) => Math.hypot(x - xs[row], y - ys[row]);
    const [x, y] = centres.reduce((best, one) => (away(one) < away(best) ? one : best));
    const key = `${x.toFixed(3)} ${y.toFixed(3)}`;
    wanted.set(key, (wanted.get(key) ?? 0) + 1);
  }
  assert.deepEqual([...count_of].sort(), [...wanted].sort());
  // Neighbours share a side: their corners are halfway between three centres.
  for (const [x, y] of corners_of(0, 0, radius)) {
    const near = centres.filter(
      (centre) => Math.abs(Math.hypot(centre[0] - x, centre[1] - y) - radius) < 1e-9,
    );
    assert.equal(near.length, 3);
  }
}

function density_check() {
  const height = 100,
    cell = 2,
    wide = 120;
  const place = () => (random() < 0.05 ? NaN : (height - 1) * random()),
    axes = [0, 1, 2].map((k) => ({ x: 30 + k * wide, ys: Float32Array.from(rows, place) }));
  const { columns, height: cells, counts } = line_density(axes, rows, { height, cell });
  assert.deepEqual([columns, cells], [(2 * wide) / cell, height / cell]);
  for (let column = 0; column < columns; ++column) {
    const gap = Math.floor((column * cell) / wide),
      share = (column * cell) / wide - gap,
      [from, to] = [axes[gap].ys, axes[gap + 1].ys];
    const crossed = rows
      .map((row) => from[row] + share * (to[row] - from[row]))
      .filter((y) => !Number.isNaN(y));
    const found = counts.subarray(column * cells, (column + 1) * cells);
    const sum = found.reduce((a, b) => a + b, 0);
    assert.ok(
      Math.abs(sum - crossed.length) < 0.01,
      `column ${column}: ${sum} of ${crossed.length}`,
    );
    // The lines above any height stay as many, but for those that cross it near here.
    for (let y = 5; y < cells; y += 5) {
      const above = found.subarray(0, y).reduce((a, b) => a + b, 0),
        least = crossed.filter((at) => at < (y - 3) * cell).length,
        most = crossed.filter((at) => at < (y + 3) * cell).length;
      assert.ok(above >= least - 0.01 && above <= most + 0.01, `${above}: ${least} to ${most}`);
    }
  }
  const one = line_density(
    axes.map(({ x }) => ({ x, ys: [41] })),
    [0],
    { height, cell },
  );
  assert.deepEqual(
    one.counts.findIndex((count) => count > 0),
    20,
  );
  assert.ok(
    one.counts.every((count, k) => count === (k % cells === 20 ? 1 : 0)),
    "a level line",
  );
}

hexagons_check();
density_check();
assert.deepEqual(quartiles_of([5, NaN, 1, 4, 2, 3], [0, 1, 2, 3, 4, 5]), [2, 3, 4]);
assert.deepEqual(quartiles_of([5, 1, 4, 2, 3], [0, 2, 4]), [3, 4, 4]);
assert.equal(quartiles_of([NaN], [0]), null);
console.log("hexagons and densities count every candidate once");
