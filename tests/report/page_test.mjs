// Drives the pages of `misalign report` as a reader would, offline, in the system's Chromium:
//   node page_test.mjs REPORT.html...
// What a page shows is compared with the data inside it, read here without the page's code.
import assert from "node:assert/strict";
import { open_browser, open_page } from "./browser.mjs";
import {
  filter_word_checks,
  layout_checks,
  no_detail_checks,
  scatter_checks,
  table_checks,
  yield_checks,
} from "./choosing_checks.mjs";
import { detail_checks, key_checks } from "./inspecting_checks.mjs";
import { address_checks, link_checks, saving_checks } from "./keeping_checks.mjs";
import { by, check, data_of, eventually, state, summary } from "./reading.mjs";

const [reports, odd] = process.argv.slice(2).reduce(
  ([whole, odd], report, i, all) => 
   all[i]=== "--odd" ? [whole, odd] : all[i-1]==="--odd" ? [whole, report] : [[...whole, report], odd], [[], null]);
if (reports.length === 0) {
  console.error("usage: node page_test.mjs REPORT.html...");
  process.exit(2);
}

async function report_checks(browser, report) {
  const data = data_of(report),
    shown = data.candidates.columns.draw?.length ?? 0;
  console.log(
    `\n${report}: ${data.campaign.name}, ${shown} candidates, ${data.details.length} with details`,
  );
  const { page, context, problems, load_ms } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
    colorScheme: "light",
  });
  console.log(`      loaded in ${load_ms.toFixed(0)} ms`);

  await check("campaign, draws and acceptance are shown", async () => {
    assert.equal(await by(page, "campaign").textContent(), data.campaign.name);
    const figures = await by(page, "figures").textContent();
    for (const [term, number] of [
      ["Draws", data.state.draws],
      ["Accepted", data.state.accepted],
      ["Undecided", data.state.undecided],
    ]) {
      const tile = by(page, "figures").locator("div", {
        has: page.getByText(term, { exact: true }),
      });
      assert.equal(await tile.locator("strong").textContent(), number.toLocaleString("en"), term);
    }
    const asked = await by(page, "asked").textContent(),
      { accept, misalignment } = data.campaign.configuration;
    assert.ok(
      asked.includes(`${accept.deploys_from_deg}°`) &&
        asked.includes(`${misalignment.amplitude_mm} mm`),
      asked,
    );
    if (data.state.acceptance.rate > 0)
      assert.match(figures, /Acceptance rate[\d.,]+ %95 %: [\d.,]+ % – [\d.,]+ %/);
  });

  const sampled = data.faults.rows.reduce((total, row) => total + row.draws, 0);
  if (sampled > 0) {
    await check("faults along the folding and on the sheet", async () => {
      assert.ok(
        (await by(page, "sample-note").textContent()).includes(sampled.toLocaleString("en")),
        "the sample's size",
      );
      assert.ok(
        (await by(page, "sample-note").textContent()).includes("1,024"),
        "one draw in 1,024",
      );
      for (const name of new Set(data.faults.rows.map((row) => row.first_fault))) {
        if (name === "none") continue;
        const words = await page
          .locator("#faults-caption .legend li")
          .evaluateAll((items) =>
            items.map((item) => [
              item.textContent,
              item.title,
              getComputedStyle(item.querySelector("i")).backgroundColor,
            ]),
          );
        for (const [short, long, colour] of words) {
          assert.ok(!/_/.test(short + long) && long.length > short.length, `words for ${short}`);
          assert.notEqual(colour, "rgba(0, 0, 0, 0)", `a colour for ${short}`);
        }
        assert.equal(
          words.length,
          new Set(data.faults.rows.map((row) => row.first_fault).filter((one) => one !== "none"))
            .size,
          "faults with words",
        );
      }
      if (data.faults.every_at_most > 1024)
        assert.ok(
          (await by(page, "sample-note").textContent()).includes(
            data.faults.every_at_most.toLocaleString("en"),
          ),
          "how many draws the later rows stand for",
        );
      const bins = new Set(
        data.faults.rows
          .filter((row) => row.fault_deg !== null && row.first_fault !== "none")
          .map(
            (row) =>
              `${row.first_fault} ${Math.ceil(row.fault_deg / Math.max(5, data.campaign.configuration.path.sample_deg))}`,
          ),
      );
      assert.equal(
        await by(page, "faults").locator('g[aria-label="rect"] rect').count(),
        bins.size,
        "bars",
      );
      const places = new Map();
      for (const { where, weight } of data.faults.rows)
        if (where) places.set(where, (places.get(where) ?? 0) + weight);
      if (places.size) {
        const most = Math.max(...places.values());
        const first = (
          await by(page, "where")
            .locator('g[aria-label^="y-axis tick label"] text')
            .first()
            .textContent()
        ).replace("–", "-");
        assert.equal(places.get(first), most, `the first bar, ${first}`);
        const widest = await by(page, "map")
          .locator("[data-where]")
          .evaluateAll(
            (nodes) =>
              nodes
                .map((node) => [parseFloat(node.style.strokeWidth), node.dataset.where])
                .sort((a, b) => b[0] - a[0])[0][1],
          );
        assert.equal(places.get(widest), most, `the map's strongest line, ${widest}`);
      }
      assert.ok(await by(page, "survival").locator("svg").count(), "survival");
    });
  }

  if (shown > 0) {
    await check("whose folding it carries is said", async () => {
      const note = await by(page, "candidates-note").textContent();
      assert.match(note, new RegExp(` ${data.details.length} draws with all details`));
      const { where, diverse } = data.chosen;
      if (where) assert.ok(note.includes(where), note);
      if (diverse) assert.ok(note.includes(`a spread of ${diverse}`), note);
    });
    await table_checks(page, data);
    await filter_word_checks(page, data);
    await layout_checks(page, data);
    await scatter_checks(page, data);
    await yield_checks(page, data);
    await no_detail_checks(page, data);
  } else {
    await check("without candidates a sentence says what to do", async () => {
      assert.match(
        await by(page, "candidates-note").textContent(),
        /search again|Run the same search/,
      );
      assert.ok(!(await page.locator("#chooser").isVisible()));
    });
  }
  if (shown > 0) await link_checks(page, data);
  const details = data.details.slice(0, report === keeping ? 2 : 1);
  for (const detail of details) await detail_checks(page, data, detail);
  if (details.length) await key_checks(page);
  if (report === keeping) {
    await address_checks(page, data);
    await saving_checks(page, data);
  }

  await check("light and dark, by the system and by the button", async () => {
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.emulateMedia({ colorScheme: "dark" });
    await eventually(
      page,
      { test: (was) => getComputedStyle(document.body).backgroundColor !== was, with: light },
      "the system's change is not followed",
    );
    const dark = await ground();
    await by(page, "theme").click();
    assert.equal(await ground(), light);
    await page.reload();
    assert.equal(await ground(), light, "the choice is not remembered");
    await by(page, "theme").click();
    assert.equal(await ground(), dark);
  });

  await check(
    "prints light, wide and long enough for paper, and returns to what it was",
    async () => {
      await page.evaluate(() => {
        window.looks = () => ({
          theme: document.documentElement.dataset.theme,
          rows: document.querySelectorAll(".line").length,
          widths: [...document.querySelectorAll("svg.plot")].map((svg) =>
            Number(svg.getAttribute("width")),
          ),
        });
        addEventListener("beforeprint", () => (window.printed = looks()));
      });
      const looks = () => page.evaluate(() => window.looks());
      const before = await looks();
      assert.equal(before.theme, "dark");
      const pdf = await page.pdf();
      assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
      const printed = await page.evaluate(() => window.printed);
      assert.equal(printed.theme, "light");
      assert.equal(printed.rows, Math.min(shown, 50), "rows on paper");
      assert.equal(printed.widths.length, before.widths.length);
      printed.widths.forEach((width, i) => assert.ok(width < before.widths[i], `chart ${i}`));
      assert.deepEqual(await looks(), before);
      return `${(pdf.length / 1024).toFixed(0)} KiB`;
    },
  );

  await check("a narrow window needs no sideways scrolling", async () => {
    await page.setViewportSize({ width: 800, height: 900 });
    await page.waitForTimeout(200);
    assert.ok(
      await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth),
      "wider than the window",
    );
  });

  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await context.close();
}

async function without_storage(browser, report) {
  await check("without storage: still works", async () => {
    const context = await browser.newContext({ colorScheme: "light" }),
      page = await context.newPage(),
      errors = [];
    page.on("pageerror", (error) => errors.push(error.message));
    await page.addInitScript(() =>
      Object.defineProperty(window, "localStorage", {
        get() {
          throw new Error("no storage");
        },
      }),
    );
    await page.goto(new URL(report, `file://${process.cwd()}/`).href);
    await page.waitForFunction(() => window.misalign !== undefined);
    await by(page, "theme").click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    assert.deepEqual(errors, []);
    await context.close();
  });
}

/** Texts of a catalogue that somebody altered: no programs, no places, and no reason to fail. */
async function odd_texts(report) {
  console.log(`\n${report}: odd texts`);
  const { page, context, problems } = await open_page(browser, report);
  await check("odd texts of a catalogue harm nothing", async () => {
    const { rows } = data_of(report).faults;
    assert.ok(rows.some(({ where }) => where?.includes("alert(1)")), "there are none");
    assert.notEqual((await state(page)).picked, null);
    assert.ok(await by(page, "metrics").isVisible());
    for (const id of ["where", "map"])
      assert.doesNotMatch(await by(page, id).textContent(), /alert/, id);
    assert.deepEqual(problems, []);
  });
  await context.close();
}

async function without_webgl(report) {
  const data = data_of(report);
  if (data.details.length === 0) return;
  console.log(`\n${report}, without WebGL`);
  const browser = await open_browser(["--disable-3d-apis"]);
  const { page, problems } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
  });
  await check("it is without WebGL, and says so", async () => {
    assert.equal(
      await page.evaluate(() => document.createElement("canvas").getContext("webgl2")),
      null,
    );
    assert.match(await page.locator("#folding-caption").textContent(), /no WebGL/);
  });
  await detail_checks(page, data, data.details[0], false);
  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await browser.close();
}

const keeping = reports.find((report) => data_of(report).details.length > 0); // once is enough
const browser = await open_browser();
for (const report of reports) await report_checks(browser, report);
await without_storage(browser, reports[0]);
if (odd) await odd_texts(odd);
await browser.close();
if (keeping) await without_webgl(keeping);
process.exit(summary() ? 0 : 1);
