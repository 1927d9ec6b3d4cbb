// Drives the pages of `misalign report` as a reader would, offline, in the system's Chromium:
//   node page_test.mjs REPORT.html... [--odd ODD.html]
// What a page shows is compared with the data inside it, read here without the page's code. ODD.html
// is of a catalogue whose places of faults are no places.
import assert from "node:assert/strict";
import { parseArgs } from "node:util";
import { access_checks } from "./access_checks.mjs";
import { beside_checks } from "./beside_checks.mjs";
import { open_browser, open_page } from "./browser.mjs";
import {
  certificate_checks,
  layout_checks,
  no_detail_checks,
  yield_checks,
} from "./choosing_checks.mjs";
import { design_check } from "./design_check.mjs";
import { detail_checks, key_checks } from "./inspecting_checks.mjs";
import {
  address_checks,
  link_checks,
  saving_checks,
  section_checks,
  survival_check,
} from "./keeping_checks.mjs";
import { limits_checks } from "./limits_checks.mjs";
import { motion_check, real_time_check } from "./motion_check.mjs";
import { looks_checks } from "./looks_checks.mjs";
import {
  carried_check,
  emptiness_check,
  faults_checks,
  figures_check,
} from "./overview_checks.mjs";
import { parallel_checks } from "./parallel_checks.mjs";
import { by, check, data_of, say, state, summary, together } from "./reading.mjs";
import { scatter_checks } from "./scatter_checks.mjs";
import { table_checks } from "./table_checks.mjs";
import { context_check, no_context_check } from "./webgl_checks.mjs";

const { positionals: reports, values } = parseArgs({
  allowPositionals: true,
  options: { odd: { type: "string" } },
});
if (reports.length === 0) {
  console.error("usage: node page_test.mjs REPORT.html... [--odd ODD.html]");
  process.exit(2);
}

async function choosing_checks(page, data) {
  await carried_check(page, data);
  await limits_checks(page, data);
  await table_checks(page, data);
  await layout_checks(page, data);
  await scatter_checks(page, data);
  await parallel_checks(page, data);
  await yield_checks(page, data);
  await certificate_checks(page, data);
  await no_detail_checks(page, data);
  await link_checks(page, data);
}

async function report_checks(browser, report) {
  const data = data_of(report),
    shown = data.candidates.columns.draw?.length ?? 0;
  say(
    `\n${report}: ${data.campaign.name}, ${shown} candidates, ${data.details.length} with details`,
  );
  const { page, context, problems, load_ms } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
    colorScheme: "light",
  });
  say(`      loaded in ${load_ms.toFixed(0)} ms`);
  await check("no word for nothing that programs have", async () => {
    const text = await page.evaluate(() => document.body.innerText);
    assert.doesNotMatch(text, /\b(null|undefined|NaN)\b/);
  });
  if (!data.state.ladder) await figures_check(page, data); // else ladder_test.mjs
  await faults_checks(page, data);
  await survival_check(page, data);
  if (shown > 0) await choosing_checks(page, data);
  else await emptiness_check(page);
  await access_checks(page, data);
  await beside_checks(page, data);
  const details = data.details.slice(0, report === keeping ? 2 : 1);
  for (const detail of details) await detail_checks(page, data, detail);
  if (details.length) await key_checks(page);
  if (report === keeping) {
    await address_checks(page, data);
    await section_checks(page, data);
    await saving_checks(page, data);
    await context_check(page);
  }
  await looks_checks(page, shown, report === keeping);
  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await context.close();
}

async function without_storage(browser, report) {
  say(`\n${report}, without storage`);
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
async function odd_texts(browser, report) {
  say(`\n${report}: odd texts`);
  const { page, context, problems } = await open_page(browser, report);
  await check("odd texts of a catalogue harm nothing", async () => {
    const { rows } = data_of(report).faults;
    assert.ok(
      rows.some(({ where }) => where?.includes("alert(1)")),
      "there are none",
    );
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
  say(`\n${report}, without WebGL`);
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

/** Each run has its own browser, so that two of them draw at the same time. */
async function in_browser(run) {
  const browser = await open_browser();
  await run(browser);
  await browser.close();
}

const keeping = reports.find((report) => data_of(report).details.length > 0); // once is enough
const others = reports.filter((report) => report !== keeping);
await together([
  () => in_browser((browser) => keeping && report_checks(browser, keeping)),
  () =>
    in_browser(async (browser) => {
      for (const report of others) await report_checks(browser, report);
      await without_storage(browser, reports[0]);
      if (keeping) {
        await design_check(browser, keeping);
        await motion_check(browser, keeping);
        await real_time_check(browser, keeping);
        await no_context_check(browser, keeping);
      }
      if (values.odd) await odd_texts(browser, values.odd);
      if (keeping) await without_webgl(keeping);
    }),
]);
process.exit(summary() ? 0 : 1);
