// The page's shares and intervals of the fault sample against its rows one by one:
//   node shares_test.mjs SHARES.js REPORT.html ROWS.json
// ROWS.json: [{"first_fault", "fault_deg", "stands_for"}] as the catalogue has them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { check, data_of, summary } from "./reading.mjs";

const [module, report, rows_file] = process.argv.slice(2);
const { effective, survival_points } = await import(pathToFileURL(resolve(module)));
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
process.exit(summary() ? 0 : 1);
