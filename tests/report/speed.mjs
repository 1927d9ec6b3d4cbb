// Measures how soon a page shows its sheet, and how many pictures a second it draws, in Chromium:
//   node speed.mjs REPORT.html...
// On request; figures are in results/report.
import { statSync } from "node:fs";
import { open_browser, open_page } from "./browser.mjs";
import { data_of } from "./reading.mjs";

const kWatch_ms = 5000;

for (const report of process.argv.slice(2)) {
  const browser = await open_browser();
  const { page } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
    reducedMotion: "no-preference",
  });
  const first_ms = await page.evaluate(() => window.misalign.first_picture_ms),
    ready_ms = await page.evaluate(() => performance.now());
  await page.waitForTimeout(1000);
  const count = () => page.evaluate(() => [window.misalign.pictures, performance.now()]);
  const [from, from_ms] = await count();
  await page.waitForTimeout(kWatch_ms);
  const [to, to_ms] = await count();
  const { sheet, candidates } = data_of(report);
  console.log(
    `${report}: ${(statSync(report).size / 1e6).toFixed(2)} MB, ${sheet.panels.length} panels, ${candidates.shown} candidates; ` +
      `first picture after ${first_ms.toFixed(0)} ms, all after ${ready_ms.toFixed(0)} ms; ` +
      `${((1000 * (to - from)) / (to_ms - from_ms)).toFixed(1)} pictures a second`,
  );
  await browser.close();
}
