// Sampled draws that came in between two states of a fault sample, against draws that are kept one
// by one:
//   node arrivals_test.mjs ARRIVALS.js [SEED]
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { check, summary } from "./reading.mjs";

const [module, seed = String(Date.now() % 1000000)] = process.argv.slice(2);
const { marks_of, random_numbers, rows_since } = await import(pathToFileURL(resolve(module)));
console.log(`seed ${seed}`);

let state = Number(seed) + 1;
const below = (n) => {
  state = (state * 48271) % 2147483647;
  return state % n;
};
const kFaults = ["not_monotone", "fold_limit", "none", "undecided"];
const random_draw = () => {
  const first_fault = kFaults[below(kFaults.length)],
    has_angle = first_fault === "not_monotone" || first_fault === "fold_limit";
  return {
    first_fault,
    fault_deg: has_angle ? 10 * (1 + below(5)) : null,
    where: first_fault === "not_monotone" ? ["A1-A2", "A3-A4"][below(2)] : null,
    accepted: first_fault === "none",
    weight: [1024, 2048, 65536][below(3)],
  };
};
/** The rows that the program's query makes of draws, in another order each time. */
function rows_of(draws) {
  const rows = [];
  for (const { weight, ...draw } of draws) {
    let row = rows.find((other) =>
      Object.entries(draw).every(([name, value]) => other[name] === value),
    );
    if (!row) rows.splice(below(rows.length + 1), 0, (row = { ...draw, sampled: 0, weight: 0 }));
    row.sampled += 1;
    row.weight += weight;
  }
  return rows;
}
const words = (rows) => rows.map((row) => JSON.stringify(Object.entries(row).sort())).sort();
const total = (rows) => rows.reduce((all, row) => all + row.weight, 0);

await check("what came in between two states is what was drawn between them", () => {
  for (let k = 0; k < 200; ++k) {
    const before = Array.from({ length: below(40) }, random_draw),
      more = Array.from({ length: below(30) }, random_draw);
    const since = rows_since(rows_of(before), rows_of([...before, ...more]));
    assert.deepEqual(words(since), words(rows_of(more)));
  }
});

await check("a sample that lost a draw has no arrivals", () => {
  const draws = Array.from({ length: 20 }, random_draw),
    more = Array.from({ length: 30 }, random_draw);
  assert.deepEqual(
    rows_since(
      rows_of(draws),
      rows_of([
        ...draws.slice(1),
        ...more.filter(({ first_fault }) => first_fault !== draws[0].first_fault),
      ]),
    ),
    [],
  );
});

await check("each mark is one sampled draw where all fit and weigh the same", () => {
  const draws = Array.from({ length: 50 }, () => ({ ...random_draw(), weight: 1024 })),
    rows = rows_of(draws).filter((row) => row.first_fault !== "undecided");
  const { marks, represents } = marks_of(rows, 60, random_numbers(1));
  assert.equal(represents, 1024);
  for (const row of rows)
    assert.equal(marks.filter((mark) => mark === row).length, row.sampled, JSON.stringify(row));
});

await check("marks share the weight, to within one mark a row, and the rest has no angle", () => {
  for (let k = 0; k < 100; ++k) {
    const rows = rows_of(Array.from({ length: 1 + below(400) }, random_draw)),
      placed = rows.filter((row) => row.first_fault !== "undecided");
    const { marks, represents } = marks_of(rows, 60, random_numbers(1));
    assert.ok(marks.length <= 60);
    assert.ok(Math.abs(marks.length * represents - total(placed)) < 1e-6 * total(placed) + 1e-9);
    for (const row of placed) {
      const count = marks.filter((mark) => mark === row).length;
      assert.ok(Math.abs(count - row.weight / represents) < 1 + 1e-9, JSON.stringify(row));
    }
  }
});

await check("the order is random, and the same each time", () => {
  const rows = rows_of(Array.from({ length: 300 }, random_draw)),
    [first, again, other] = [1, 1, 2].map((s) => marks_of(rows, 60, random_numbers(s)).marks);
  assert.deepEqual(again, first);
  assert.notDeepEqual(other, first);
  const places = first.map((row) => rows.indexOf(row));
  assert.notDeepEqual(
    places,
    [...places].sort((a, b) => a - b),
  );
});
process.exit(summary() ? 0 : 1);
