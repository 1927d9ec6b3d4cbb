// Twelve questions of a reader, each answered by at most two clicks from the top of a report:
//   node questions_test.mjs REPORT.html
// An answer is on the screen, and is what the data inside the page say.
import assert from "node:assert/strict";
import { open_browser, open_page } from "./browser.mjs";
import { by, check, data_of, say, state, summary } from "./reading.mjs";

const kMostClicks = 2;
const [report] = process.argv.slice(2);
const data = data_of(report);
const { columns } = data.candidates;
const [best] = data.details;
const browser = await open_browser();
const { page, problems } = await open_page(browser, report, {
  viewport: { width: 1400, height: 900 },
});

let clicks = 0;
const press = async (place) => {
  ++clicks;
  await place.click();
};
const choose = async (place, value) => {
  ++clicks;
  await place.selectOption(value);
};
const section = (name) => press(page.locator(`.top nav a[href="#${name}"]`));

/** The text at a place, which must be seen without scrolling. */
async function seen(place) {
  await page.waitForFunction(
    (node) => {
      const { top, bottom } = node.getBoundingClientRect();
      return bottom > 0 && top < innerHeight;
    },
    await place.elementHandle(),
  );
  return place.innerText();
}

async function question(words, answer) {
  await page.evaluate(() => (location.hash = ""));
  await page.reload();
  await page.waitForFunction(() => window.misalign !== undefined);
  clicks = 0;
  await check(words, async () => {
    await answer();
    assert.ok(clicks <= kMostClicks, `${clicks} clicks`);
    return `${clicks} clicks`;
  });
}

const fact = (name) => by(page, "sheet-facts").locator("div", { hasText: name }).locator("dd");
const number_in = (text) => Number.parseFloat(text.replace("−", "-").replaceAll(",", ""));
const near = (text, value, share = 0.01) =>
  assert.ok(Math.abs(number_in(text) - value) <= share * Math.abs(value), `${text}, not ${value}`);

await question("How far folded does it still deploy?", async () =>
  near(await seen(fact("deploys from")), best.verdict.deploys_from_deg),
);
await question("How does it look stowed?", async () => {
  await press(by(page, "mark-depth"));
  await seen(by(page, "folding"));
  assert.equal((await state(page)).pilot_deg, best.verdict.deploys_from_deg);
});
await question("How exactly must I cut it?", async () =>
  near(await seen(fact("miscut margin")), best.metrics.miscut_margin_mm),
);
await question("Is its motion proved?", async () => {
  const proof = data.certificates.find(({ draw }) => draw === best.draw);
  const text = await seen(fact("certified"));
  if (proof) assert.ok(number_in(text) <= proof.certified_deg, text);
  else assert.equal(text, "–");
});
await question("Will hinge friction hold it?", async () =>
  near(await seen(fact("critical friction")), best.let_go.critical_friction_n_mm_per_mm),
);
await question("Which sheet has the smallest stroke?", async () => {
  const least = Math.min(...columns.stroke_max);
  await press(page.locator(".head button", { hasText: "largest stroke" }));
  await press(page.locator(".line").first());
  const [, draw] = (await seen(by(page, "pilot-whose"))).split(" ");
  assert.equal(columns.stroke_max[columns.draw.indexOf(draw)], least);
});
await question("What makes the third better than the fifth?", async () => {
  const [third, fifth] = [2, 4].map((k) => data.details[k].draw);
  await choose(by(page, "detailed").first(), third);
  await choose(by(page, "hold-choice"), fifth);
  const row = by(page, "beside").locator('tr[data-metric="stroke_max"] td');
  const values = [third, fifth].map((draw) => columns.stroke_max[columns.draw.indexOf(draw)]);
  const texts = await row.allInnerTexts();
  texts.forEach((text, k) => near(text, 100 * values[k]));
  assert.ok(await by(page, "held-folding").isVisible());
  assert.ok(await by(page, "beside-own-histories").locator("svg").first().isVisible());
});
await question("Which vertex is which?", async () => {
  await press(by(page, "vertex-names-button").first());
  const names = by(page, "vertex-names").first().locator("span");
  assert.equal(await names.count(), data.sheet.vertices_mm.length);
  await seen(names.first());
});
await question("How fast does it deploy?", async () => {
  await section("inspect");
  const words = await by(page, "let-go-caption").innerText();
  if (best.let_go.deploy_time_s !== null)
    near(/after ([\d.]+) s/.exec(words)[1], best.let_go.deploy_time_s);
});
await question("How strongly do its springs unfold it where they are weakest?", async () => {
  await section("inspect");
  const words = await by(page, "actuation").innerText();
  near(/([\d.]+) N mm/.exec(words.slice(words.indexOf("Weakest")))[1], best.weakest.moment_n_mm);
});
await question("Why do draws fail?", async () => {
  await section("overview");
  await seen(page.locator("#campaign-name"));
  assert.ok(await by(page, "faults").locator("svg").first().isVisible());
});
await question("How do I get drawings to cut?", async () => {
  await press(by(page, "sheet-next").getByTestId("copy").last());
  assert.match(await seen(by(page, "command-svg")), new RegExp(`export .*${best.draw}.* svg`, "s"));
});
await check("no errors, no requests", async () => assert.deepEqual(problems, []));
await browser.close();
say("");
process.exit(summary() ? 0 : 1);
