// Pictures of a report for people to look at, as on a desk, light and dark:
//   node screenshots.mjs REPORT.html DIRECTORY [DRAW]        DRAW: one with details
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { open_browser, open_page } from "./browser.mjs";

const [report, directory, draw] = process.argv.slice(2);
const kParts = {
  overview: "#overview",
  candidates: "#candidates",
  folding: "#views > .grid >> nth=0",
  charts: "#views > .grid >> nth=1",
  facts: "#facts",
};

mkdirSync(directory, { recursive: true });
const browser = await open_browser([], { ignoreDefaultArgs: ["--hide-scrollbars"] });
for (const theme of ["light", "dark"]) {
  const { page, problems } = await open_page(browser, report, {
    colorScheme: theme,
    viewport: { width: 1500, height: 900 },
  });
  if (draw) await page.getByTestId("detailed").selectOption(draw);
  // Sticky bars would lie across a picture that is higher than the window.
  await page.addStyleTag({
    content: "html { scrollbar-width: none } .top, .pilot { position: static !important }",
  });
  await page.waitForTimeout(500);
  for (const [part, place] of Object.entries(kParts)) {
    const section = page.locator(place);
    if (!(await section.isVisible())) continue;
    await section.scrollIntoViewIfNeeded();
    await section.screenshot({ path: join(directory, `${part}-${theme}.png`) });
  }
  if (problems.length) console.error(problems.join("\n"));
  await page.close();
}
await browser.close();
