// The site to look at: the first page's moving drawing and six cards, the gallery first among the sections, and no page
// wider than a phone.
import { existsSync, readdirSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { kPatience_ms } from "./browser.mjs";

const kCards = [
  "Cut one",
  "Shape one",
  "Understand",
  "Run on a cluster",
  "From Python",
  "Evidence",
];
const kPhone = { width: 390, height: 844 };
const kWidths = [1400, 800, kPhone.width];
const kStill = 12; // pictures of what may not move, a quarter of a second apart

/** Writes down what no reader should meet: errors, warnings, requests to a network. */
export function watch_page(page, problems) {
  page.setDefaultTimeout(kPatience_ms);
  page.on("pageerror", ({ message }) => problems.push(`${page.url()}: error: ${message}`));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()))
      problems.push(`${page.url()}: console: ${message.text()}`);
  });
  page.on("requestfailed", (request) => problems.push(`${page.url()}: no ${request.url()}`));
  page.on("request", (request) => {
    if (!/^(file|data):/.test(request.url())) problems.push(`asks for ${request.url()}`);
  });
}

/** The page at this address, with these preferences, as long as USE takes. */
async function with_page(browser, address, options, problems, use) {
  const context = await browser.newContext({ offline: true, ...options });
  const page = await context.newPage();
  watch_page(page, problems);
  await page.goto(address);
  await use(page);
  await context.close();
}

/** Parts of the article that reach beyond the window, read in the page; tables scroll by themselves. */
function overflows() {
  const wide = [];
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) wide.push("the page");
  for (const pre of document.querySelectorAll("pre"))
    if (pre.scrollWidth > pre.clientWidth) wide.push(pre.textContent.slice(0, 60));
  const article = document.querySelector("article");
  const texts = document.createTreeWalker(article ?? document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const node = texts.currentNode;
    if (!node.data.trim()) continue;
    if (node.parentElement.closest("pre, script, style, .table-wrapper:not(.cards *)")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    if ([...range.getClientRects()].some(({ right }) => right > width + 0.5))
      wide.push(node.data.slice(0, 60));
  }
  return wide;
}

/** Six cards, each with a picture that is seen and a link to a page of its own. */
async function check_cards(page, problems) {
  const cards = await page.locator(".cards :is(th, td)").evaluateAll(async (each) => {
    await Promise.all([...document.images].map((image) => image.decode().catch(() => {})));
    return each.map((card) => {
      const image = card.querySelector("a img");
      return {
        title: card.querySelector("a")?.innerText.trim(),
        href: card.querySelector("a")?.href,
        natural: image?.naturalWidth ?? 0,
        width: image?.getBoundingClientRect().width ?? 0,
        card: card.getBoundingClientRect().width,
      };
    });
  });
  const titles = cards.map(({ title }) => title);
  if (titles.join() !== kCards.join()) problems.push(`cards: ${titles}`);
  if (new Set(cards.map(({ href }) => href)).size !== kCards.length)
    problems.push("cards lead to the same page");
  for (const { title, href, natural, width, card } of cards) {
    if (!href || !existsSync(new URL(href.split("#")[0])))
      problems.push(`card ${title}: leads nowhere: ${href}`);
    if (!(natural > 0 && width > 0.9 * card)) problems.push(`card ${title}: no picture`);
  }
}

/** The sheet of the first page moves, but not for readers who want no motion. */
async function check_motion(browser, address, problems) {
  const moves = (reducedMotion) =>
    with_page(browser, address, { reducedMotion }, problems, async (page) => {
      const sheet = page.locator("article img").first();
      const look = async () => (await sheet.screenshot()).toString("base64");
      if (!(await sheet.evaluate((image) => image.decode().then(() => image.naturalWidth > 0))))
        problems.push("no sheet on the first page");
      const before = await look();
      const tries = reducedMotion === "reduce" ? kStill : kPatience_ms / 250;
      let moved = false;
      for (let i = 0; i < tries && !moved; ++i) {
        await page.waitForTimeout(250);
        moved = (await look()) !== before;
      }
      if (moved === (reducedMotion === "reduce"))
        problems.push(`reduced motion "${reducedMotion}": the sheet ${moved ? "moves" : "rests"}`);
    });
  await moves("no-preference");
  await moves("reduce");
}

export async function check_looks(browser, site, problems) {
  const first = pathToFileURL(`${site}/index.html`).href;
  for (const width of kWidths)
    for (const colorScheme of ["light", "dark"])
      await with_page(
        browser,
        first,
        { viewport: { width, height: 900 }, colorScheme, reducedMotion: "reduce" },
        problems,
        async (page) => {
          await check_cards(page, problems);
          for (const what of await page.evaluate(overflows))
            problems.push(`first page, ${width} px: too wide: ${what}`);
          const sections = await page
            .locator(".sidebar-tree li.toctree-l1 > a")
            .evaluateAll((each) => each.map((link) => link.textContent));
          if (sections[0] !== "Gallery") problems.push(`sections: ${sections}`);
        },
      );
  await check_motion(browser, first, problems);

  // The page with the longest JSON is one of them.
  const pages = readdirSync(site, { recursive: true }).filter((name) => name.endsWith(".html"));
  await with_page(browser, first, { viewport: kPhone }, problems, async (page) => {
    let longest = 0;
    for (const name of pages) {
      await page.goto(pathToFileURL(`${site}/${name}`).href);
      longest = Math.max(
        longest,
        ...(await page.locator("pre").allTextContents()).flatMap(longest_line),
      );
      for (const what of await page.evaluate(overflows))
        problems.push(`${name}: too wide for a phone: ${what}`);
    }
    console.log(
      `${pages.length} pages ${kPhone.width} px wide; the longest line of code: ${longest}`,
    );
    if (longest < 100) problems.push("no long line of code was seen");
  });
}

const longest_line = (text) => Math.max(...text.split("\n").map(({ length }) => length));
