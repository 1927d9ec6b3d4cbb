// Pictures of a report, light and dark, for people to look at:
//   node screenshots.mjs REPORT.html DIRECTORY [WIDTH] [DRAW]        DRAW: one with details
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { open_browser, open_page } from "./browser.mjs";

const [report, directory, width = "1400", draw] = process.argv.slice(2);
mkdirSync(directory, { recursive: true });
const browser = await open_browser();
for (const theme of ["light", "dark"]) {
  const { page, problems } = await open_page(browser, report, {
    colorScheme: theme,
    viewport: { width: Number(width), height: 900 },
  });
  if (draw) await page.getByTestId("detailed").selectOption(draw);
  await page.waitForTimeout(500);
  const parts = {
    overview: "#overview",
    candidates: "#candidates",
    folding: "#views > .grid >> nth=0",
    charts: "#views > .grid >> nth=1",
    facts: "#facts",
  };
  for (const [part, place] of Object.entries(parts)) {
    const section = page.locator(place);
    if (!(await section.isVisible())) continue;
    await section.scrollIntoViewIfNeeded();
    // Sticky bars would lie across a picture that is higher than the window.
    await page.addStyleTag({ content: ".top, .pilot { position: static !important }" });
    await section.screenshot({ path: join(directory, `${part}-${theme}.png`) });
  }
  if (problems.length) console.error(problems.join("\n"));
  await page.close();
}
await browser.close();
