// The page of a campaign whose sheets are accepted by their energy: no diagonal need be monotone.
//   node energy_test.mjs REPORT.html
import assert from "node:assert/strict";
import { open_browser, open_page } from "./browser.mjs";
import { by, check, data_of, summary } from "./reading.mjs";

const [report] = process.argv.slice(2);
const { columns } = data_of(report).candidates;
const browser = await open_browser();
const { page } = await open_page(browser, report, { viewport: { width: 1400, height: 900 } });
await check("the first axes of the scatter have values", async () => {
  assert.ok(
    columns.slope_min_mm_per_deg.every((value) => value === null),
    "a least slope",
  );
  for (const axis of ["scatter-x", "scatter-y"]) {
    const name = await by(page, axis).inputValue();
    assert.ok(
      columns[name].some((value) => value !== null),
      `${axis}: ${name}`,
    );
  }
});
await browser.close();
process.exit(summary() ? 0 : 1);
