// The overview of a splitting search against what the program itself says of the same catalogue:
//   node ladder_test.mjs NAME...
// NAME.html is the page, NAME-levels.json what `query acceptance --json` answers ([] where no level
// is known), NAME-status.txt what `status` prints.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { open_browser, open_page } from "./browser.mjs";
import { axis, by, check, data_of, summary } from "./reading.mjs";

/** "8.77 %", "1.23 × 10⁻⁵", "1,234" as a number; nothing as null. */
function number_of(text) {
  if (text === "" || text === "–") return null;
  const match = /^([\d.,]+)(?: × 10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?( %)?$/.exec(text);
  assert.ok(match, `“${text}” is no number`);
  const exponent = [...(match[2] ?? "")]
    .map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c))
    .reduce((value, digit) => (digit < 0 ? value : 10 * value + digit), 0);
  const size = Number(match[1].replaceAll(",", "")),
    sign = match[2]?.startsWith("⁻") ? -1 : 1;
  return (size * 10 ** (sign * exponent)) / (match[3] ? 100 : 1);
}

/** Three digits are shown. */
function same(shown, wanted, what) {
  if (wanted === null) return assert.equal(shown, null, what);
  assert.notEqual(shown, null, `${what}: nothing, not ${wanted}`);
  assert.ok(
    Math.abs(shown - wanted) <= 0.0051 * Math.abs(wanted),
    `${what}: ${shown}, not ${wanted}`,
  );
}

const interval_of = (text) => {
  const [low = null, high = null] = text === "" ? [] : text.split(" – ").map(number_of);
  return { low, high };
};

const tile = (page, term) =>
  by(page, "figures").locator("div", { has: page.getByText(term, { exact: true }) });
const value_of = async (page, term) => tile(page, term).locator("strong").textContent();

async function asked_check(page, data) {
  await check("what was asked is said in words", async () => {
    const words = await by(page, "asked").textContent(),
      { search, accept } = data.campaign.configuration;
    const numbers = [
      [search.first_draws, "first draw"],
      [search.particles, "particle"],
      [search.sweeps, "sweep"],
    ];
    assert.match(words, /Searched by splitting/);
    assert.ok(words.includes(`${accept.deploys_from_deg}°`), words);
    for (const [many, what] of numbers)
      assert.match(
        words,
        new RegExp(` ${many.toLocaleString("en")} ${what}${many > 1 ? "s" : "\\b"}`),
      );
    if (search.levels_deg === "auto")
      assert.match(words, /levels? that a level finder (found|finds first)/);
    else
      for (const deg of search.levels_deg.slice(0, 12)) assert.ok(words.includes(`${deg}°`), words);
  });
}

async function figures_check(page, data, levels) {
  await check("populations, candidates, share and ancestors are shown", async () => {
    const populations = levels[0]?.populations_here ?? 0,
      last = levels.at(-1);
    assert.equal(number_of(await value_of(page, "Populations")), populations);
    assert.equal(number_of(await value_of(page, "Candidates kept")), data.state.accepted);
    const share = await value_of(page, "Share of draws"),
      beside = await tile(page, "Share of draws").locator(".note").textContent();
    if (!last) return assert.equal(share, "–");
    same(number_of(share), last.rate, "share");
    if (last.rate_low === null)
      assert.match(beside, /^(no interval|no population|nothing searched)/);
    else {
      const { low, high } = interval_of(beside.replace("95 %: ", ""));
      same(low, last.rate_low, "low");
      same(high, last.rate_high, "high");
    }
    same(number_of(await value_of(page, "One in")), last.rate > 0 ? 1 / last.rate : null, "one in");
    assert.equal(number_of(await value_of(page, "Ancestors")), levels.at(-2).ancestors);
    const drawn = levels[0].particles.toLocaleString("en");
    assert.match(
      await tile(page, "Ancestors").textContent(),
      new RegExp(`of ${drawn} first draws`),
    );
  });
}

async function goal_check(page, data, levels, status) {
  await check("how far it is, and what lies beyond the goal", async () => {
    const missing = /, (\d+) of them missing/.exec(status)?.[1],
      words = await tile(page, "Populations").locator(".note").textContent();
    if (missing) {
      const [, goal] = /^of ([\d,]+), the last run's goal$/.exec(words);
      assert.equal(
        number_of(goal),
        number_of(await value_of(page, "Populations")) + Number(missing),
      );
    } else assert.equal(words, /without end/.test(status) ? "campaign without end" : "complete");
    const all = data.state.draws_in_ledger / 1e10,
      beyond = all - (levels[0]?.populations_here ?? 0);
    assert.equal(await tile(page, "Beyond the goal").count(), beyond > 0 ? 1 : 0);
    if (beyond > 0) assert.equal(number_of(await value_of(page, "Beyond the goal")), beyond);
    else assert.equal(data.state.accepted, data.candidates.total);
    return words;
  });
}

async function table_check(page, levels) {
  await check("a row for each level, as `query acceptance` has it", async () => {
    const rows = await by(page, "ladder-levels")
      .locator("tbody tr")
      .evaluateAll((nodes) => nodes.map((row) => [...row.cells].map((cell) => cell.textContent)));
    assert.equal(rows.length, levels.length, "rows");
    rows.forEach((cells, k) => {
      const level = levels[k],
        is_first = k === 0,
        is_last = k + 1 === levels.length;
      assert.equal(cells[0], String(level.level));
      const { low, high } = interval_of(cells[3]);
      const wanted = [
        ["from", number_of(cells[1]), level.deploys_from_deg],
        ["share", number_of(cells[2]), is_first ? null : level.rate],
        ["low", low, is_first ? null : level.rate_low],
        ["high", high, is_first ? null : level.rate_high],
        [
          "reach next",
          number_of(cells[4]),
          is_last || level.particles === 0 ? null : level.survivors / level.particles,
        ],
        [
          "moves accepted",
          number_of(cells[5]),
          is_first || level.tried === 0 ? null : level.taken / level.tried,
        ],
      ];
      for (const [what, shown, number] of wanted) same(shown, number, `level ${k}: ${what}`);
      assert.equal(number_of(cells[6]), level.met, `level ${k}: met`);
      assert.ok(Math.abs(Number(cells[7]) - level.worker_seconds) <= 0.051, `level ${k}: core s`);
    });
    return `${rows.length} rows`;
  });
}

async function missed_check(page, levels) {
  await check("the first level to which no population has come is named", async () => {
    const words = await page.locator("#ladder-words").textContent(),
      missed = levels[0].populations_here > 0 && levels.find(({ rate }) => rate === 0);
    if (!missed) return assert.doesNotMatch(words, /No population/);
    assert.ok(words.includes(`has reached ${missed.deploys_from_deg}°.`), words);
  });
}

async function chart_check(page, levels) {
  const box = by(page, "ladder-chart"),
    above = levels.filter(({ level, rate }) => level > 0 && rate > 0),
    bars = above.filter(({ rate_low }) => rate_low !== null);
  await check("the chart has a point and an interval for each level that was reached", async () => {
    if (above.length === 0) return assert.equal(await box.isVisible(), false, "a chart of nothing");
    const x = levels.length > 2 ? await axis(box, "x") : null,
      y = await axis(box, "y", Math.log10);
    const near = (shown, wanted, what) =>
      assert.ok(Math.abs(shown - wanted) < 1, `${what}: ${shown}, not ${wanted}`);
    const numbers = (group, names) =>
      box
        .locator(`g[aria-label="${group}"] > *`)
        .evaluateAll(
          (nodes, wanted) =>
            nodes.map((node) => wanted.map((name) => Number(node.getAttribute(name)))),
          names,
        );
    const dots = await numbers("dot", ["cx", "cy"]),
      rules = await numbers("rule", ["x1", "y1", "y2"]);
    assert.equal(dots.length, above.length, "points");
    assert.equal(rules.length, bars.length, "intervals");
    dots.forEach(([cx, cy], k) => {
      if (x) near(cx, x(above[k].deploys_from_deg), `angle of point ${k}`);
      near(cy, y(above[k].rate), `share of point ${k}`);
    });
    const { bottom } = await box
      .locator("svg.plot")
      .evaluate((svg) => ({ bottom: Number(svg.getAttribute("height")) - 42 }));
    rules.forEach(([x1, y1, y2], k) => {
      const { rate_low, rate_high, deploys_from_deg } = bars[k];
      if (x) near(x1, x(deploys_from_deg), `angle of interval ${k}`);
      near(y1, rate_low > 0 ? Math.min(bottom, y(rate_low)) : bottom, `low end ${k}`);
      near(y2, y(rate_high), `high end ${k}`);
    });
    const svg = box.locator("svg.plot");
    assert.match(await svg.getAttribute("aria-label"), /deploy from each level/);
    assert.ok(
      (await svg.getAttribute("aria-description")).includes(
        `deploy from ${Number(above.at(-1).deploys_from_deg.toFixed(2))}°`,
      ),
      "its description",
    );
    return `${dots.length} points, ${rules.length} intervals`;
  });
}

async function saving_check(page, data, levels) {
  if (!levels.some(({ level, rate }) => level > 0 && rate > 0)) return; // no chart
  await check("the levels are saved as CSV, with seven digits", async () => {
    const card = page.locator(".card").filter({ has: by(page, "ladder-chart") });
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      card.getByTestId("save-csv").click(),
    ]);
    assert.equal(download.suggestedFilename(), `${data.campaign.name}-ladder.csv`);
    const text = (await readFile(await download.path())).toString().trim();
    const [heads, ...rows] = text.split("\r\n").map((line) => line.split(","));
    assert.equal(rows.length, levels.length);
    const columns = { share: "rate", low_95: "rate_low", high_95: "rate_high" };
    for (const name of ["level", "deploys_from_deg", "ancestors", "tried", "taken", "met"])
      columns[name] = name;
    for (const [head, name] of Object.entries(columns))
      rows.forEach((row, k) => {
        const saved = row[heads.indexOf(head)],
          wanted = levels[k][name];
        if (wanted === null) return assert.equal(saved, "", head);
        assert.ok(Math.abs(Number(saved) - wanted) <= 1e-6 * Math.abs(wanted), `${head}: ${saved}`);
      });
    const buttons = await card.locator(".saving button").allTextContents();
    assert.deepEqual(buttons, ["CSV", "PNG", "SVG"]);
  });
}

async function sentence_check(page, status, levels) {
  await check("why the rate is not reliable yet is said as `status` says it", async () => {
    const says = by(page, "ladder-says"),
      lines = status.split("\n"),
      reasons = lines.filter((line) => /not reliable yet|an interval is shown/.test(line));
    assert.equal(await says.isVisible(), reasons.length > 0 && levels.length > 0);
    if (reasons.length === 0) return "nothing to say";
    const words = await says.textContent();
    assert.equal(`${words[0].toLowerCase()}${words.slice(1)}`, `${reasons[0]}.`);
    return reasons[0];
  });
}

async function nothing_plain_check(page) {
  await check("nothing of what only plain draws have, and no card is empty", async () => {
    for (const id of ["faults", "survival", "where", "map", "sample-note"])
      assert.equal(await by(page, id).isVisible(), false, `${id} is shown`);
    const empty = await page
      .locator("#overview .card:visible")
      .evaluateAll((cards) =>
        cards
          .filter((card) => !card.querySelector("svg.plot, table"))
          .map((card) => card.querySelector("h3").textContent),
      );
    assert.deepEqual(empty, []);
    const text = await page.locator("body").innerText();
    assert.doesNotMatch(text, /undefined|NaN|\bnull\b|Infinity/);
    assert.doesNotMatch(await by(page, "figures").innerText(), /Accepted|Acceptance/);
  });
}

/** The widths of a desk and of a phone. */
async function layout_check(page) {
  await check("long numbers break no layout", async () => {
    for (const width of [1400, 800, 390]) {
      await page.setViewportSize({ width, height: 900 });
      await page.evaluate(
        () => new Promise((done) => requestAnimationFrame(() => setTimeout(done, 60))),
      );
      const { page_wide, cut } = await page.evaluate(() => ({
        page_wide: document.documentElement.scrollWidth - innerWidth,
        cut: [...document.querySelectorAll("#figures > div, #picked-title, #detailed, .command")]
          .filter((box) => box.checkVisibility() && box.scrollWidth > box.clientWidth + 1)
          .map((box) => box.textContent),
      }));
      assert.ok(page_wide <= 0, `${width} px: ${page_wide} px wider than the window`);
      assert.deepEqual(cut, [], `${width} px`);
    }
    await page.setViewportSize({ width: 1400, height: 900 });
  });
}

async function sheet_check(page, data) {
  const [detail] = data.details;
  if (!detail) return;
  await check("sheets have their numbers, and say which population met them", async () => {
    assert.match(detail.draw, /^\d+$/);
    await by(page, "detailed").selectOption(detail.draw);
    assert.ok((await by(page, "picked").textContent()).startsWith(`Sheet ${detail.draw}`));
    const population = detail.draw.slice(0, -10) || "0"; // a population has ten digits of numbers
    assert.match(
      await by(page, "picked-words").textContent(),
      new RegExp(` Met by population ${population}\\.$`),
    );
  });
}

/** The mean of no populations is no share, whatever is written there. */
function levels_of(file) {
  const levels = JSON.parse(readFileSync(file, "utf8"));
  if (levels[0]?.populations_here === 0) for (const level of levels) level.rate = null;
  return levels;
}

const names = process.argv.slice(2);
const browser = await open_browser();
for (const name of names) {
  const data = data_of(`${name}.html`),
    levels = levels_of(`${name}-levels.json`),
    status = readFileSync(`${name}-status.txt`, "utf8");
  console.log(`\n${name}.html: ${levels.length} levels, ${data.candidates.total} candidates`);
  const { page, context, problems } = await open_page(browser, `${name}.html`, {
    viewport: { width: 1400, height: 900 },
  });
  await asked_check(page, data);
  await figures_check(page, data, levels);
  await goal_check(page, data, levels, status);
  await sentence_check(page, status, levels);
  await nothing_plain_check(page);
  if (levels.length > 0) {
    await table_check(page, levels);
    await missed_check(page, levels);
    await chart_check(page, levels);
    await saving_check(page, data, levels);
  } else
    await check("that no level is known yet is said", async () => {
      assert.match(await page.locator("#ladder-note").textContent(), /^No level is known yet/);
      assert.equal(await by(page, "ladder-levels").isVisible(), false);
    });
  await sheet_check(page, data);
  await layout_check(page);
  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await context.close();
}
await browser.close();
process.exit(summary() && names.length ? 0 : 1);
