// The comparison of two campaigns on the page of `misalign report --beside`:
//   node two_campaigns_test.mjs REPORT.html
// The page is also read with other data in it: another second campaign than the catalogue's.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { open_browser, open_page } from "./browser.mjs";
import { axis, by, check, data_of, summary } from "./reading.mjs";

const [report] = process.argv.slice(2);
const text = readFileSync(report, "utf8"),
  folder = mkdtempSync(join(tmpdir(), "two-campaigns-"));
const browser = await open_browser();

/** Opens the page with other data. */
async function open_with(data) {
  const path = join(folder, "page.html"),
    json = JSON.stringify(data).replaceAll("<", "\\u003c");
  writeFileSync(
    path,
    text.replace(/(id="report-data">)[^]*?(<\/script>)/, (_, open, end) => open + json + end),
  );
  const opened = await open_page(browser, path, { viewport: { width: 1400, height: 900 } });
  return { ...opened, words: await by(opened.page, "two-campaigns-words").textContent() };
}

/** The table's rows: { label: [{ text, bold }…] }. */
const table_of = async (page) =>
  Object.fromEntries(
    await by(page, "two-campaigns-table")
      .locator("tbody tr")
      .evaluateAll((lines) =>
        lines.map((line) => [
          line.querySelector("th").textContent,
          [...line.querySelectorAll("td")].map((cell) => ({
            text: cell.textContent,
            bold: Number(getComputedStyle(cell).fontWeight) >= 600,
          })),
        ]),
      ),
  );
const texts = (cells) => cells.map((cell) => cell.text);
const bold = (cells) => cells.map((cell) => cell.bold);
const whole = (value) => value.toLocaleString("en");

/** Bars of the histogram, counted from the rows: one a fault and 5 degrees, or one a sample. */
const bars_in = ({ faults }, width_deg) =>
  new Set(
    faults.rows
      .filter((row) => row.fault_deg !== null && row.first_fault !== "none")
      .map((row) => `${row.first_fault} ${Math.ceil(row.fault_deg / width_deg)}`),
  ).size;

/** The map from shares to pixels of a logarithmic axis, from its ticks: "0.1 %", "1 × 10⁻⁴ %". */
async function log_axis(box) {
  const ticks = await box.locator('g[aria-label^="y-axis tick label"] text').evaluateAll((nodes) =>
    nodes.map((node) => {
      const digits = node.textContent
        .replace(/ %$/, "")
        .replace("1 × 10", "1e")
        .replace(/[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]/g, (c) => "-0123456789"["⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c)]);
      return [Number(digits) / 100, Number(/,([-\d.]+)\)/.exec(node.getAttribute("transform"))[1])];
    }),
  );
  const [[low, low_px], [high, high_px]] = [ticks[0], ticks.at(-1)];
  return (share) =>
    low_px + (Math.log10(share / low) / Math.log10(high / low)) * (high_px - low_px);
}

async function colours_check(page, both) {
  await check("survival and D of both are in two colours, with their names", async () => {
    for (const id of ["survivals", "reach"]) {
      const colours = await by(page, id)
          .locator('g[aria-label="line"]')
          .evaluateAll((lines) => lines.map((line) => getComputedStyle(line).stroke)),
        keys = await page
          .locator(".card", { has: by(page, id) })
          .locator(".sides i")
          .evaluateAll((nodes) => nodes.map((node) => getComputedStyle(node).backgroundColor));
      assert.equal(new Set(keys).size, 2, id);
      // There is no line where there are no candidates.
      const has_line = (k) => id === "survivals" || both[k].angles.length > 0;
      assert.deepEqual(
        colours,
        keys.filter((_, k) => has_line(k)),
        id,
      );
    }
  });
}

async function reach_check(page, both) {
  await check("D of candidates is where its share of the draws is", async () => {
    const box = by(page, "reach"),
      x = await axis(box, "x"),
      y = await log_axis(box);
    const dots = await box
      .locator('g[aria-label="dot"] circle')
      .evaluateAll((nodes) =>
        nodes.map((node) => ["cx", "cy"].map((key) => Number(node.getAttribute(key)))),
      );
    const with_candidates = both.filter((side) => side.angles.length > 0);
    with_candidates.forEach(({ angles, state }, k) => {
      const [best_deg, candidates] = angles.at(-1),
        [cx, cy] = dots[k];
      assert.ok(Math.abs(cx - x(best_deg)) < 1, `${cx} is not at ${best_deg}°`);
      const wanted = y(candidates / state.draws_in_ledger);
      assert.ok(Math.abs(cy - wanted) < 1, `${cy}, not ${wanted}`);
    });
  });
}

async function catalogue_checks(data) {
  const both = [data, data.beside],
    { page, context, problems, words } = await open_with(data);
  await check("the key figures are those of both catalogues", async () => {
    const table = await table_of(page);
    assert.deepEqual(
      texts(table.Draws),
      both.map(({ state }) => whole(state.draws)),
    );
    assert.deepEqual(
      texts(table.Accepted),
      both.map(({ state }) => whole(state.accepted)),
    );
    assert.deepEqual(
      texts(table["Best D"]),
      both.map(({ angles }) =>
        angles.length ? `${Math.max(...angles.map(([deg]) => deg))}°` : "–",
      ),
    );
    assert.deepEqual(
      texts(table["Fault sample (draws)"]),
      both.map(({ faults }) => whole(faults.rows.reduce((all, row) => all + row.sampled, 0))),
    );
    const thresholds = both.map((side) => side.campaign.configuration.accept.deploys_from_deg);
    assert.deepEqual(
      texts(table.Threshold),
      thresholds.map((deg) => `${deg}°`),
    );
    if (thresholds[0] === thresholds[1]) return;
    assert.deepEqual(texts(table["accept.deploys_from_deg"]), thresholds.map(String));
    assert.deepEqual(bold(table["Acceptance rate"]), [false, false], "other criteria");
    assert.match(words, /The thresholds differ/);
  });
  await check("both histograms have one scale, and all bars", async () => {
    const width_deg = Math.max(5, ...both.map((s) => s.campaign.configuration.path.sample_deg)),
      scales = [];
    for (const k of [0, 1]) {
      const box = by(page, `faults-${k}`);
      assert.equal(
        await box.locator('g[aria-label="rect"] rect').count(),
        bars_in(both[k], width_deg),
        `bars of ${k}`,
      );
      const [x, y] = [await axis(box, "x"), await axis(box, "y")];
      scales.push([x(0), x(100), y(0), y(10)]);
    }
    assert.deepEqual(scales[0], scales[1]);
  });
  await colours_check(page, both);
  await reach_check(page, both);
  await check("a narrow page does not scroll sideways", async () => {
    await page.setViewportSize({ width: 390, height: 900 });
    await page.waitForFunction(
      () => document.documentElement.scrollWidth <= document.documentElement.clientWidth,
    );
  });
  await check("no word for nothing, no errors, no requests", async () => {
    assert.doesNotMatch(await by(page, "two-campaigns").innerText(), /\b(null|undefined|NaN)\b/);
    assert.deepEqual(problems, []);
  });
  await context.close();
}

/** The page's first campaign as the second one, with other results. */
function with_second(data, change) {
  const { catalogue, campaign, state, faults, angles } = structuredClone(data),
    beside = { catalogue, campaign, state, faults, angles };
  change(beside);
  return { ...data, beside };
}
const rates = (draws, accepted, rate_low, rate_high) => ({
  ...{ draws, accepted },
  acceptance: { rate: accepted / draws, rate_low, rate_high, relative_error: null },
});

async function other_results(data) {
  const first = { ...data, state: { ...data.state, ...rates(100, 50, 0.4, 0.6) } };
  await check("an interval that includes 0 resolves no difference, and marks no rate", async () => {
    const { page, context, words } = await open_with(
      with_second(first, ({ state, campaign }) => {
        campaign.configuration.seed = 2;
        Object.assign(state, rates(100, 40, 0.3, 0.5));
      }),
    );
    // 10 points, and the root of 0.1² + 0.1² on both sides.
    assert.match(
      words,
      /first less .*, second: 10\.0+ percentage points, 95 % interval −4\.14 to 24\.1\./,
    );
    assert.match(words, /1\.25 times the rate.*includes 0: the difference is not larger/);
    assert.doesNotMatch(words, /thresholds differ|same draws/);
    assert.deepEqual(bold((await table_of(page))["Acceptance rate"]), [false, false]);
    await context.close();
  });
  await check("a resolved difference under one criterion is marked, and the larger D", async () => {
    const { page, context, words } = await open_with(
      with_second(first, ({ state, angles }) => {
        Object.assign(state, rates(100, 80, 0.7, 0.87));
        angles.push([angles.at(-1)[0] + 1, 1]);
      }),
    );
    assert.match(words, /: −30\.0 percentage points/);
    assert.match(words, /excludes 0: the difference is larger/);
    assert.match(words, /Both campaigns make the same draws/);
    const table = await table_of(page);
    for (const label of ["Acceptance rate", "Best D"])
      assert.deepEqual(bold(table[label]), [false, true], label);
    for (const [label, cells] of Object.entries(table))
      if (!["Acceptance rate", "Best D"].includes(label))
        assert.ok(!bold(cells).includes(true), `${label} is marked`);
    await context.close();
  });
  await check("a second campaign without results harms nothing", async () => {
    const { page, context, problems, words } = await open_with(
      with_second(data, (side) => {
        Object.assign(side.state, rates(0, 0, 0, 1), { draws_in_ledger: 0 });
        side.state.acceptance.rate = null;
        side.faults.rows = [];
        side.angles = [];
      }),
    );
    assert.equal(words, "One of the campaigns has no draw yet.");
    for (const id of ["survivals", "faults-1"])
      assert.equal(await by(page, id).isVisible(), false, id);
    assert.doesNotMatch(await by(page, "two-campaigns").innerText(), /\b(null|undefined|NaN)\b/);
    assert.deepEqual(problems, []);
    await context.close();
  });
  await check("no comparison without a second campaign", async () => {
    const { page, context, words } = await open_with({ ...data, beside: undefined });
    assert.equal(words, "");
    assert.equal(await by(page, "two-campaigns").isVisible(), false);
    await context.close();
  });
}

const data = data_of(report);
await catalogue_checks(data);
await other_results(data);
await browser.close();
rmSync(folder, { recursive: true });
process.exit(summary() ? 0 : 1);
