// Twelve questions of a reader, each answered by at most two clicks from the top of a report:
//   node questions_test.mjs REPORT.html FRICTION.html STRESS.html
// of reports, one with the column of critical friction, one whose first sheet has stresses. An
// answer is on the screen, and is what the data inside the page say.
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { open_browser, open_page } from "./browser.mjs";
import { by, check, data_of, median, pixels_of, say, state, summary } from "./reading.mjs";

const kMostClicks = 2;
const [report, of_friction, of_stress] = process.argv.slice(2);
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
const move = async (slider, place) => {
  ++clicks;
  await slider.fill(String(place));
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

async function question(words, answer, asked = report) {
  await page.goto("about:blank"); // the page's address must not be kept
  await page.goto(pathToFileURL(resolve(asked)).href);
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
await question(
  "Which sheet is best for my friction?",
  async () => {
    const { draw, critical_friction_n_mm_per_mm: critical } =
        data_of(of_friction).candidates.columns,
      limit = by(page, "limit-critical_friction_n_mm_per_mm"),
      [least, most] = [Math.min(...critical), Math.max(...critical)],
      mine = median(critical);
    await section("candidates");
    await move(limit, Math.ceil((200 * (mine - least)) / (most - least)));
    const shown = number_in(await seen(limit.locator("xpath=following-sibling::output")));
    assert.ok(shown > 0.98 * mine && shown < mine + (most - least) / 100, `${shown} for ${mine}`);
    assert.ok(critical[0] < shown, "the best of all would do");
    const line = page.locator(".line").first();
    await seen(line);
    assert.equal(
      await line.getAttribute("data-draw"),
      draw[critical.findIndex((value) => value >= shown)], // the best come first
    );
  },
  of_friction,
);
await question(
  "Where is it stressed?",
  async () => {
    const { sheet, details } = data_of(of_stress),
      { panels_mpa } = details[0].stress,
      hardest = panels_mpa.indexOf(Math.max(...panels_mpa));
    await press(page.getByText("Top view", { exact: true }).first());
    const { count, x, y } = await pixels_of(page, "stress-most");
    assert.ok(count > 300, `${count} pixels of the largest stress`);
    await by(page, "folding-canvas").hover({ position: { x, y } });
    const words = await seen(by(page, "panel-tip"));
    assert.ok(words.startsWith(`panel [${sheet.panel_places[hardest].join(", ")}]: `), words);
    near(words.split(": ")[1], panels_mpa[hardest]);
  },
  of_stress,
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
