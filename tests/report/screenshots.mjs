// Pictures of a report for people to look at, as on a desk (scripts/pictures.sh):
//   node screenshots.mjs PAGE DIRECTORY PART,... [ADDRESS]   PART-light.png, PART-dark.png of a file or of a served page
//   node screenshots.mjs PAGE DIRECTORY film [ADDRESS]       one deployment, 000.png, 001.png, ...
// ADDRESS is what the page's address has behind its #, such as draw=7.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { open_browser, open_page } from "./browser.mjs";

// Names of pictures, and where each is on the page.
const kParts = {
  overview: "#overview",
  candidates: "#candidates",
  folding: "#sheet",
  charts: "#views",
  facts: "#facts",
  watch: "#overview",
};
const kFilmed = "#folding",
  kUnfilmed = "#folding :is(button, details) { visibility: hidden }",
  kPilot = "#pilot-bar input[type=range]";
// Sticky bars would lie across a picture that is higher than the window; sections get a margin.
const kStyle = `html { scrollbar-width: none } .top, .pilot { position: static !important }
  section { margin-inline: -16px; padding: 16px }`;
const kWindowStyle = ".top { position: sticky !important } .pilot { visibility: hidden }";
const kWide = { width: 1500, height: 1000 },
  kFilmedWindow = { width: 1200, height: 900 };
const kFrames = 40,
  kFolded = 0.85; // share of the slider where the film begins
const kSettled_ms = 1000;
const kWindows = ["watch"]; // pictures of the whole window, with the bar at its top

async function opened(browser, page_file, options, address) {
  const { page, problems } = /^http:/.test(page_file)
    ? { page: await (await browser.newContext(options)).newPage(), problems: [] }
    : await open_page(browser, page_file, options);
  if (page.url() === "about:blank") await page.goto(page_file);
  await page.evaluate((hash) => hash && (location.hash = hash), address);
  await page.addStyleTag({ content: kStyle });
  await page.waitForTimeout(kSettled_ms);
  return { page, problems };
}

async function parts(browser, page_file, directory, names, address) {
  for (const theme of ["light", "dark"]) {
    const options = { colorScheme: theme, viewport: kWide };
    const { page, problems } = await opened(browser, page_file, options, address);
    for (const name of names) {
      const path = join(directory, `${name}-${theme}.png`);
      assert.ok(name in kParts, `there is no part ${name}`);
      const part = page.locator(kParts[name]);
      assert.ok(await part.isVisible(), `the page has no ${name}`);
      if (kWindows.includes(name)) await page.addStyleTag({ content: kWindowStyle });
      await part.evaluate((element) => element.scrollIntoView({ behavior: "instant" }));
      await page.waitForTimeout(kSettled_ms); // what has been scrolled to is painted
      await (kWindows.includes(name) ? page : part).screenshot({ path });
    }
    assert.deepEqual(problems, []);
    await page.close();
  }
}

/** A deployment that is slow at both ends. */
async function film(browser, page_file, directory, address) {
  const options = { colorScheme: "light", viewport: kFilmedWindow };
  const { page, problems } = await opened(browser, page_file, options, address);
  await page.addStyleTag({ content: kUnfilmed });
  const last = await page.locator(kPilot).evaluate((slider) => Number(slider.max));
  for (let k = 0; k < kFrames; ++k) {
    const share = (1 + Math.cos((Math.PI * k) / (kFrames - 1))) / 2;
    await page.locator(kPilot).fill(String(Math.round(kFolded * last * share)));
    await page.evaluate(
      () => new Promise((drawn) => requestAnimationFrame(() => setTimeout(drawn))),
    );
    const path = join(directory, `${String(k).padStart(3, "0")}.png`);
    await page.locator(kFilmed).screenshot({ path });
  }
  assert.deepEqual(problems, []);
}

const [page_file, directory, what, address] = process.argv.slice(2);
mkdirSync(directory, { recursive: true });
const browser = await open_browser([], { ignoreDefaultArgs: ["--hide-scrollbars"] });
if (what === "film") await film(browser, page_file, directory, address);
else await parts(browser, page_file, directory, what.split(","), address);
await browser.close();
