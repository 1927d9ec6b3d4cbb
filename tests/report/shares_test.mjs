// The page's shares and intervals of the fault sample against its rows one by one:
//   node shares_test.mjs SHARES.js REPORT.html ROWS.json
// ROWS.json: [{"first_fault", "fault_deg", "stands_for"}] as the catalogue has them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { check, data_of, summary } from "./reading.mjs";

const [module, report, rows_file] = process.argv.slice(2);
const { difference_of, effective, survival_points } = await import(pathToFileURL(resolve(module)));
const data = data_of(report),
  rows = JSON.parse(readFileSync(rows_file, "utf8"));
const near = (seen, expected, what) =>
  assert.ok(Math.abs(seen - expected) < 1e-12, `${what}: ${seen}, not ${expected}`);

let all = 0,
  squares = 0;
for (const { stands_for } of rows) {
  all += stands_for;
  squares += stands_for * stands_for;
}
await check("rows of several weights", () => {
  assert.ok(new Set(rows.map((row) => row.stands_for)).size > 1, "only one weight");
  near(effective(data.faults.rows), (all * all) / squares, "effective number");
  assert.equal(data.faults.every_at_most, Math.max(...rows.map((row) => row.stands_for)));
});
await check("survival by angle", () => {
  const points = survival_points(data.faults.rows, data.campaign.configuration);
  assert.ok(points.length > 3, "angles");
  for (const { angle, share, low, high } of points) {
    let beyond = 0;
    for (const { first_fault, fault_deg, stands_for } of rows)
      if (first_fault === "none" || (fault_deg ?? 0) > angle) beyond += stands_for;
    near(share, beyond / all, `share beyond ${angle}`);
    const n = (all * all) / squares;
    // Wilson: the ends are the shares from which what was seen is 1.96 standard errors away.
    for (const end of [low, high]) {
      if (end === 1 || end === 0) continue; // cut off
      near(
        (share - end) ** 2,
        (1.96 ** 2 * end * (1 - end)) / n,
        `end of the interval at ${angle}`,
      );
    }
    assert.ok(low <= share && share <= high, `interval at ${angle}`);
  }
});
/** The end of Wilson's interval in [from, to], by bisection of its definition. */
function wilson_end(k, n, from, to) {
  const inside = (p) => (k / n - p) ** 2 <= (1.959964 ** 2 * p * (1 - p)) / n;
  let [outer, inner] = from === k / n ? [to, from] : [from, to];
  for (let i = 0; i < 60; ++i) {
    const middle = (outer + inner) / 2;
    if (inside(middle)) inner = middle;
    else outer = middle;
  }
  return inner;
}
await check("the difference of two shares, as Newcombe's Table II has it", () => {
  const share_of = (k, n) => ({
    rate: k / n,
    rate_low: wilson_end(k, n, 0, k / n),
    rate_high: wilson_end(k, n, k / n, 1),
  });
  // Method 10, contrast (a): 56/70 - 48/80; and (b): 9/10 - 3/10.
  for (const [first, second, low, high] of [
    [share_of(56, 70), share_of(48, 80), 0.0524, 0.3339],
    [share_of(9, 10), share_of(3, 10), 0.1705, 0.809],
  ]) {
    const seen = difference_of(first, second);
    assert.equal(seen.difference, first.rate - second.rate);
    assert.ok(Math.abs(seen.low - low) < 5e-5, `low end ${seen.low}, not ${low}`);
    assert.ok(Math.abs(seen.high - high) < 5e-5, `high end ${seen.high}, not ${high}`);
    const back = difference_of(second, first);
    near(back.low, -seen.high, "the other way round");
    near(back.high, -seen.low, "the other way round");
  }
});
process.exit(summary() ? 0 : 1);
