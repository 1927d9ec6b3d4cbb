// Marks that move on the chart of first faults: the replay of a report, and arrivals on a page that
// a server keeps up to date. The server is this test's, so that it is known what comes in:
//   node passage_test.mjs REPORT.html
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { open_browser, open_page } from "./browser.mjs";
import { axis, by, check, data_of, summary } from "./reading.mjs";

const [report] = process.argv.slice(2);
const data = data_of(report),
  { path, accept } = data.campaign.configuration;
const browser = await open_browser();
const kMoves = { viewport: { width: 1400, height: 900 }, reducedMotion: "no-preference" };
const kMostReplayed = 240;

const marks_on = (page) => page.locator("#passage .mark");
const animations = (page) =>
  page.evaluate(async () => {
    const all = document.getElementById("passage").getAnimations({ subtree: true });
    await Promise.all(all.map((animation) => animation.ready)); // none is about to pause
    return all.map(({ currentTime, playState }) => ({ at_ms: currentTime, state: playState }));
  });

/** Marks and rings after all have arrived: their middle relative to the chart, fault and colour. */
async function arrived(page) {
  return page.evaluate(() => {
    const svg = document.getElementById("passage"),
      frame = svg.getBoundingClientRect();
    for (const animation of svg.getAnimations({ subtree: true })) {
      const { delay, duration } = animation.effect.getComputedTiming(),
        is_mark = animation.effect.target.classList.contains("mark");
      animation.currentTime = delay + (is_mark ? duration - 500 : 1);
    }
    return [...svg.querySelectorAll("circle")].map((node) => {
      const { x, y, width, height } = node.getBoundingClientRect();
      return {
        kind: node.getAttribute("class"),
        fault: node.dataset.fault,
        x: x + width / 2 - frame.x,
        y: y + height / 2 - frame.y,
        colour: getComputedStyle(node).fill,
      };
    });
  });
}

const bars_of = (page) =>
  by(page, "faults")
    .locator('g[aria-label="rect"] rect')
    .evaluateAll((nodes) =>
      nodes.map((node) => ({
        left: Number(node.getAttribute("x")),
        right: Number(node.getAttribute("x")) + Number(node.getAttribute("width")),
        top: Number(node.getAttribute("y")),
        bottom: Number(node.getAttribute("y")) + Number(node.getAttribute("height")),
        colour: getComputedStyle(node).fill,
      })),
    );

async function hiding_checks(page) {
  await check("a hidden page pauses, a shown one goes on, and the replay ends", async () => {
    const hide = (hidden) =>
      page.evaluate((value) => {
        Object.defineProperty(document, "hidden", { value, configurable: true });
        document.dispatchEvent(new Event("visibilitychange"));
      }, hidden);
    await page.evaluate(() => {
      for (const animation of document.getElementById("passage").getAnimations({ subtree: true }))
        animation.currentTime = 0;
    });
    await by(page, "passage-pause").press("Enter");
    const states = async () => new Set((await animations(page)).map(({ state }) => state));
    assert.deepEqual(await states(), new Set(["running"]));
    await hide(true);
    assert.deepEqual(await states(), new Set(["paused"]));
    await hide(false);
    assert.deepEqual(await states(), new Set(["running"]));
    await hide(true); // so that it does not end by itself
    await by(page, "passage-replay").click();
    await hide(false);
    assert.equal(await marks_on(page).count(), 0);
    assert.equal(await by(page, "passage-replay").textContent(), "▶ Replay");
  });
  await check("a reader who wants less motion is offered none", async () => {
    await page.emulateMedia({ reducedMotion: "reduce" });
    for (const id of ["passage-replay", "passage-pause"])
      await by(page, id).waitFor({ state: "hidden" });
    assert.equal(await by(page, "passage-words").textContent(), "");
  });
}

async function replay_checks() {
  const { page, context, problems } = await open_page(browser, report, kMoves);
  const box = by(page, "faults");
  await box.scrollIntoViewIfNeeded();
  const x = await axis(box, "x");
  await check("nothing moves until that is wanted", async () => {
    assert.equal(await marks_on(page).count(), 0);
    assert.equal(await by(page, "passage-pause").isVisible(), false);
  });
  await by(page, "passage-replay").click();
  await by(page, "passage-pause").press("Space");
  await check(
    "the replay pauses by a key, and says its order and what a mark represents",
    async () => {
      const before = await animations(page);
      assert.ok(before.length > 0 && before.every(({ state }) => state === "paused"));
      await page.waitForTimeout(100);
      assert.deepEqual(await animations(page), before);
      const placed = data.faults.rows.filter(
          (row) => row.first_fault === "none" || row.fault_deg !== null,
        ),
        sampled = placed.reduce((all, row) => all + row.sampled, 0),
        weight = placed.reduce((all, row) => all + row.weight, 0),
        each = Math.round(weight / Math.min(kMostReplayed, sampled)).toLocaleString("en"),
        words = await by(page, "passage-words").textContent();
      assert.match(words, /random order with a fixed seed/);
      assert.ok(words.includes(`Each mark: ${each} draws.`), words);
      assert.equal(await marks_on(page).count(), Math.min(kMostReplayed, sampled));
      return `${sampled} sampled draws`;
    },
  );
  await check("every mark rests at its first fault, in a bar of its colour", async () => {
    const bars = await bars_of(page),
      known = data.faults.rows.map((row) => ({ ...row, x: x(row.fault_deg ?? path.end_deg) })),
      all = await arrived(page);
    for (const mark of all.filter(({ kind }) => kind === "mark")) {
      const words = JSON.stringify(mark);
      assert.ok(
        known.some((row) => row.first_fault === mark.fault && Math.abs(row.x - mark.x) < 1),
        `no such fault: ${words}`,
      );
      if (mark.fault === "none") continue;
      const is_in = (bar) =>
        bar.left - 1.5 < mark.x &&
        mark.x < bar.right + 1.5 &&
        bar.top - 4 < mark.y &&
        mark.y < bar.bottom + 1;
      assert.ok(
        bars.some((bar) => bar.colour === mark.colour && is_in(bar)),
        `no such bar: ${words}`,
      );
    }
    const rings = all.filter(({ kind }) => kind === "ring");
    if (data.faults.rows.some((row) => row.accepted) && all.length < kMostReplayed)
      assert.ok(rings.length > 0, "no ring");
    for (const ring of rings) assert.ok(Math.abs(ring.x - x(accept.deploys_from_deg)) < 1);
    return `${all.length - rings.length} marks, ${rings.length} rings`;
  });
  await hiding_checks(page);
  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await context.close();
}

/** A page that asks a server of this test; `come_in(rows)` adds rows to the sample. */
async function watched() {
  const faults = structuredClone(data.faults);
  let read_at_s = 1;
  const page_text = readFileSync(report, "utf8")
    .replace("connect-src 'none'", "connect-src 'self'")
    .replace(/(id="report-data">)\{/, '$1{"watch":{"live":"live","sheet":"sheet/"},');
  const server = createServer((request, response) => {
    if (request.url === "/") return response.setHeader("Content-Type", "text/html").end(page_text);
    const state = { ...data.state, complete: false };
    const live = { state, faults, writing: true, read_at_s, total: data.candidates.total };
    return response.end(JSON.stringify({ ...live, best: {}, angles: [] }));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  return {
    server,
    url: `http://127.0.0.1:${server.address().port}/`,
    come_in(rows) {
      for (const row of rows) {
        const old = faults.rows.find((other) =>
          ["first_fault", "fault_deg", "where", "accepted"].every((key) => other[key] === row[key]),
        );
        if (old) for (const key of ["sampled", "weight", "weight_sq"]) old[key] += row[key];
        else faults.rows.push({ ...row });
      }
      read_at_s += 1;
    },
  };
}

const row = (first_fault, fault_deg, accepted, sampled) => ({
  ...{ first_fault, fault_deg, where: null, accepted, sampled },
  ...{ weight: 1024 * sampled, weight_sq: 1024 ** 2 * sampled },
});

async function pausing_checks(page, come_in, { added, said }) {
  await check("while it is paused nothing is added but the words", async () => {
    await by(page, "passage-pause").focus();
    await page.keyboard.press("Space");
    assert.equal(await by(page, "passage-pause").getAttribute("aria-pressed"), "true");
    come_in([row("fold_limit", 95, false, 7)]);
    await said("7 sampled draws, which represent 7,168 draws: 7 fold limit; accepted: 0.");
    assert.deepEqual(await added(), []);
    await page.keyboard.press("Space");
    await page.waitForFunction(() => document.getElementById("passage").childElementCount === 0);
  });
  await check("with less motion the words alone say what came in", async () => {
    await page.emulateMedia({ reducedMotion: "reduce" });
    come_in([row("fold_limit", 100, false, 1)]);
    await said("1 sampled draw, which represents 1,024 draws: 1 fold limit; accepted: 0.");
    assert.deepEqual(await added(), []);
    assert.equal(await by(page, "passage-pause").isVisible(), false);
  });
}

async function arrival_checks() {
  const { server, url, come_in } = await watched();
  const context = await browser.newContext(kMoves),
    page = await context.newPage(),
    problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") problems.push(message.text());
  });
  await page.goto(url);
  await page.waitForFunction(() => window.misalign !== undefined);
  await by(page, "passage").scrollIntoViewIfNeeded();
  // Marks may be gone before they are counted: what was added is noted.
  await page.evaluate(() => {
    window.added = [];
    new MutationObserver((changes) => {
      for (const { addedNodes } of changes)
        for (const node of addedNodes)
          window.added.push(`${node.getAttribute("class")} ${node.dataset.fault ?? ""}`.trim());
    }).observe(document.getElementById("passage"), { childList: true });
  });
  const added = () => page.evaluate(() => window.added.splice(0).sort());
  const said = (words) =>
    page.waitForFunction(
      (wanted) => document.getElementById("passage-words").textContent.includes(wanted),
      words,
    );
  await check("arrivals move, and are named with what they represent", async () => {
    come_in([
      row("fold_limit", 95, false, 3),
      row("none", null, true, 2),
      row("undecided", null, false, 1),
    ]);
    await said(
      "6 sampled draws, which represent 6,144 draws: 3 fold limit, 1 undecided, 2 no fault; accepted: 2.",
    );
    await said("Each mark: 1,024 draws.");
    const of = (n, word) => Array(n).fill(word);
    assert.deepEqual(await added(), [
      ...of(3, "mark fold_limit"),
      ...of(2, "mark none"),
      ...of(2, "ring"),
    ]);
  });
  await check("marks go, and nothing is done while nothing comes in", async () => {
    await page.waitForFunction(() => document.getElementById("passage").childElementCount === 0);
    assert.deepEqual(await animations(page), []);
    come_in([]);
    await page.waitForResponse(`${url}live`);
    await page.waitForResponse(`${url}live`);
    assert.deepEqual(await added(), []);
  });
  await check("the number of marks is limited", async () => {
    come_in([row("not_monotone", 75, false, 6000)]);
    await said("Each mark: 102,400 draws.");
    assert.deepEqual(await added(), Array(60).fill("mark not_monotone"));
  });
  await pausing_checks(page, come_in, { added, said });
  await check("no errors", async () => assert.deepEqual(problems, []));
  await context.close();
  server.close();
}

await replay_checks();
await arrival_checks();
await browser.close();
process.exit(summary() ? 0 : 1);
