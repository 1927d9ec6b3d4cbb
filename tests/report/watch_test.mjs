// The page of `misalign watch`, while a campaign runs; of a catalogue with texts that are programs; and
// of one that cannot be read because of such a text:
//   node watch_test.mjs campaign|hostile|problem URL
import assert from "node:assert/strict";
import { kPatience_ms, open_browser } from "./browser.mjs";
import { by, check, summary } from "./reading.mjs";

const [what, url] = process.argv.slice(2);
const browser = await open_browser();

async function open(whole = true) {
  const context = await browser.newContext({
    reducedMotion: "reduce",
    viewport: { width: 1400, height: 900 },
  });
  const page = await context.newPage(),
    problems = [],
    asked = new Set();
  page.setDefaultTimeout(kPatience_ms);
  page.on("dialog", (dialog) => {
    problems.push(`dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on("pageerror", (error) => problems.push(`error: ${error.message}`));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type()) && !/GPU stall/.test(message.text()))
      problems.push(`console: ${message.text()}`);
  });
  page.on("request", (request) => asked.add(request.url()));
  await page.goto(url);
  if (whole) await page.waitForFunction(() => window.misalign !== undefined);
  return { context, page, problems, asked };
}

const tile = (page, term) =>
  by(page, "figures").locator("div", { has: page.getByText(term, { exact: true }) });
const number_in = async (page, term) =>
  Number((await tile(page, term).locator("strong").textContent()).replaceAll(",", ""));

/** Once it is larger than `than`. */
async function grown(page, term, than) {
  const end = Date.now() + kPatience_ms;
  while (Date.now() < end) {
    const now = await number_in(page, term);
    if (now > than) return now;
    await page.waitForTimeout(100);
  }
  throw new Error(`${term} stays at ${than}`);
}

const state_is = (page, words) =>
  page.waitForFunction(
    (wanted) => document.getElementById("watch-state").textContent.startsWith(wanted),
    words,
  );

async function hostile_checks() {
  const { page, problems } = await open();
  await check("texts of a catalogue are texts", async () => {
    await state_is(page, "complete");
    await page.waitForTimeout(500);
    assert.equal(await page.locator("main img").count(), 0);
    assert.deepEqual(problems, []);
  });
}

async function problem_checks() {
  const { page, problems } = await open(false);
  await check("a sentence about a catalogue is a text, and says what is wrong", async () => {
    await state_is(page, "catalogue unreadable");
    const words = await page.locator("#broken").textContent();
    assert.ok(words.includes("<script>alert(1)") && words.includes("name"), words);
    assert.equal(await page.locator("main img").count(), 0);
    assert.equal(await page.locator("section:visible").count(), 0);
    assert.deepEqual(
      problems.filter((problem) => !/status of 503/.test(problem)),
      [],
    );
  });
}

async function loading_check(page) {
  await check(
    "new candidates are loaded when that is wanted; filter and picked draw stay",
    async () => {
      const rows = () => page.evaluate(() => document.querySelector('[role="grid"]').ariaRowCount);
      const load = by(page, "watch-load");
      await load.waitFor({ state: "visible" });
      assert.match(await load.textContent(), /^Load [\d,]+ new candidates?$/);
      await by(page, "filter").fill("deploys_from_deg >= 21");
      await page.waitForFunction(() => location.hash.includes("filter="));
      const written = await page.locator("#foot").textContent();
      // A page that took long to make is made anew only after a while; until then the old one comes again.
      let loaded = written;
      for (const end = Date.now() + kPatience_ms; loaded === written && Date.now() < end;) {
        await load.waitFor({ state: "visible" });
        await Promise.all([page.waitForEvent("load"), load.click()]);
        await page.waitForFunction(() => window.misalign !== undefined);
        loaded = await page.locator("#foot").textContent();
      }
      assert.notEqual(loaded, written, "the same page");
      assert.equal(await by(page, "filter").inputValue(), "deploys_from_deg >= 21");
      return `${await rows()} rows`;
    },
  );
}

async function folding_check(page) {
  await check("a sheet without details is folded when that is wanted", async () => {
    const bare = await page.evaluate(() => {
      const { details, candidates } = JSON.parse(
        document.getElementById("report-data").textContent,
      );
      const detailed = new Set(details.map(({ draw }) => draw));
      return candidates.columns.draw.find((draw) => !detailed.has(draw));
    });
    await by(page, "filter").fill(`draw = ${bare}`);
    await by(page, "grid").locator(".line").first().click();
    assert.equal(await by(page, "folding").isVisible(), false);
    // Another campaign, whose catalogue took the place of this one, is not shown.
    await page.route("**/sheet/*", (route) =>
      route.fulfill({ body: JSON.stringify({ detail: { draw: bare }, identity: "00000000" }) }),
    );
    await by(page, "compute").click();
    await page.waitForFunction(() =>
      document
        .querySelector('[data-testid="compute-says"]')
        .textContent.includes("another campaign"),
    );
    await page.unroute("**/sheet/*");
    assert.equal(await by(page, "folding").isVisible(), false);
    await by(page, "compute").click();
    await by(page, "folding").waitFor({ state: "visible" });
    assert.equal(await by(page, "detailed").inputValue(), bare);
    assert.ok((await by(page, "picked").textContent()).includes(bare));
    assert.equal(await by(page, "grid").locator(".line .dot").count(), 1);
    return `draw ${bare}`;
  });
}

async function others_check(context) {
  await check("pages of other sites can neither read it nor frame it", async () => {
    const other = await context.newPage();
    await other.goto("data:text/html,<title>other</title>");
    const read = await other.evaluate(
      (place) =>
        fetch(`${place}live`).then(
          (answer) => answer.text(),
          () => "refused",
        ),
      url,
    );
    assert.equal(read, "refused");
    const framed = await other.evaluate(async (place) => {
      const frame = document.createElement("iframe");
      frame.src = place;
      document.body.append(frame);
      await new Promise((done) => (frame.onload = done));
      return frame.contentDocument === null;
    }, url);
    assert.ok(framed);
    assert.ok(
      other.frames().every((frame) => !frame.url().startsWith(url)),
      "it is framed",
    );
    await other.close();
  });
}

async function campaign_checks() {
  const { context, page, problems, asked } = await open();
  await check("it says that it is live", () => state_is(page, "live"));
  await check("draws and candidates move", async () => {
    const draws = await number_in(page, "Draws"),
      accepted = await number_in(page, "Accepted");
    const then = await grown(page, "Draws", draws);
    await grown(page, "Accepted", accepted);
    await grown(page, "Draws per second", 0);
    return `${draws} to ${then}`;
  });
  await check("the best and the ladder of angles are shown, and the ladder moves", async () => {
    assert.equal(await tile(page, "Best so far").locator("strong").textContent(), "30°");
    const caption = page.locator("#angles-caption"),
      before = await caption.textContent();
    assert.match(before, /^All [\d,]+ candidates of the catalogue; [\d,]+ deploy from 30°\.$/);
    assert.equal(await by(page, "angles").locator("svg.plot").count(), 1);
    await page.waitForFunction(
      (then) => document.getElementById("angles-caption").textContent !== then,
      before,
    );
  });
  await check(
    "one picture a chart, and one row of buttons, however often they were drawn",
    async () => {
      for (const id of ["angles", "faults", "survival"]) {
        const card = page.locator(".card").filter({ has: by(page, id) });
        if (!(await card.isVisible())) continue;
        assert.equal(await by(page, id).locator("svg.plot").count(), 1, id);
        assert.equal(await card.locator(".saving").count(), 1, id);
      }
    },
  );
  await loading_check(page);
  await folding_check(page);
  await check("it says when nobody answers, and when somebody does again", async () => {
    await state_is(page, "live");
    const before = problems.length;
    await context.setOffline(true);
    await state_is(page, "no answer");
    assert.match(await by(page, "watch-says").textContent(), /does not answer/);
    await context.setOffline(false);
    await state_is(page, "live");
    assert.equal(await by(page, "watch-says").isVisible(), false);
    problems.splice(before); // the browser's own words about being offline
  });
  await others_check(context);
  await check("no errors, and nobody else is asked", async () => {
    assert.deepEqual(problems, []);
    const others = [...asked].filter(
      (address) =>
        address.split("#")[0] !== url &&
        address !== `${url}live` &&
        !/^sheet\/\d+$/.test(address.slice(url.length)) &&
        !address.startsWith("data:"),
    );
    assert.deepEqual(others, []);
  });
}

await { campaign: campaign_checks, hostile: hostile_checks, problem: problem_checks }[what]();
await browser.close();
process.exit(summary() ? 0 : 1);
