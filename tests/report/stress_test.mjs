// Panels coloured by their stress, and those that meet:
//   node stress_test.mjs REPORT.html...
// of reports whose first sheet has both.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { open_browser, open_page } from "./browser.mjs";
import { axis, by, check, data_of, eventually, floats, pixels_of, summary } from "./reading.mjs";

async function light_up(page, scheme) {
  await page.emulateMedia({ colorScheme: scheme });
  await eventually(
    page,
    { test: (wanted) => document.documentElement.dataset.theme === wanted, with: scheme },
    `the page is not ${scheme}`,
  );
}

const go = (page, k) =>
  by(page, "pilot").evaluate((node, value) => {
    node.value = value;
    node.dispatchEvent(new Event("input", { bubbles: true }));
  }, k);

const panel_words = ({ sheet }, panel) => `panel [${sheet.panel_places[panel].join(", ")}]`;
const mpa_in = (text) => Number(/([\d.,]+) MPa/.exec(text)[1].replaceAll(",", ""));
const is_close = (shown, value) => Math.abs(shown - value) <= 0.0051 * Math.abs(value);

async function colour_checks(page, data, { panels_mpa }) {
  const most = Math.max(...panels_mpa),
    hardest = panels_mpa.indexOf(most);
  await check("panels have the colours of the scale, by day and by night", async () => {
    await go(page, 0);
    await page.getByText("Top view", { exact: true }).click();
    assert.equal(await by(page, "stress-button").getAttribute("aria-pressed"), "true");
    const scale = await by(page, "stress-scale").innerText();
    assert.ok(
      scale.startsWith("0 MPa") && is_close(mpa_in(scale.replace("0 MPa", "")), most),
      scale,
    );
    for (const scheme of ["dark", "light"]) {
      await light_up(page, scheme);
      const { count } = await pixels_of(page, "stress-most");
      assert.ok(count > 300, `${scheme}: ${count} pixels of the hardest panel's colour`);
      assert.ok((await pixels_of(page, "panel-front")).count < 30, `${scheme}: a panel without`);
    }
  });
  await check("the panel under the pointer says its stress", async () => {
    const canvas = by(page, "folding-canvas");
    await canvas.scrollIntoViewIfNeeded();
    const { x, y } = await pixels_of(page, "stress-most");
    await canvas.hover({ position: { x, y } });
    const words = await by(page, "panel-tip").innerText();
    assert.ok(
      words.startsWith(`${panel_words(data, hardest)}: `) && is_close(mpa_in(words), most),
      words,
    );
    await page.mouse.move(2, 2);
    assert.ok(!(await by(page, "panel-tip").isVisible()));
  });
  await check("the caption speaks of two tones only where there are two", async () => {
    const words = () => page.locator("#folding-caption").textContent();
    assert.match(await words(), /^Colour: largest stress/);
    await by(page, "stress-button").click();
    assert.match(await words(), /^Light: the side/);
    await by(page, "stress-button").click();
  });
  await check("the button takes the colours away and brings them back", async () => {
    await by(page, "stress-button").click();
    assert.equal(await by(page, "stress-button").getAttribute("aria-pressed"), "false");
    assert.ok(!(await by(page, "stress-scale").isVisible()), "a scale of nothing");
    assert.ok((await pixels_of(page, "stress-most")).count < 30, "still coloured");
    await by(page, "stress-button").click();
    assert.ok((await pixels_of(page, "stress-most")).count > 300, "not coloured again");
    assert.ok(await by(page, "stress-scale").isVisible());
  });
}

async function card_checks(page, data, stress) {
  const { panels_mpa, largest } = stress;
  await check("the card says the largest stress, mesh, material and outcome", async () => {
    const words = await by(page, "stress-card").innerText();
    assert.ok(is_close(mpa_in(words), largest.stress_mpa), words);
    for (const text of [
      `panel [${largest.panel.join(", ")}]`,
      `${stress.elements_a_side} × ${stress.elements_a_side}`,
      stress.material.name,
      stress.deployed_s === null ? "not deployed" : "deployed after",
    ])
      assert.ok(words.includes(text), `no “${text}”: ${words}`);
  });
  await check("each panel's stress is listed, the largest first", async () => {
    await page.locator("#stress-card summary").click();
    const lines = await by(page, "stress-panels").locator("li").allInnerTexts(),
      order = panels_mpa.map((_, i) => i).sort((a, b) => panels_mpa[b] - panels_mpa[a]);
    assert.equal(lines.length, data.sheet.panels.length);
    order.forEach((panel, i) => {
      const line = lines[i].trim();
      assert.ok(
        line.startsWith(`${panel_words(data, panel)}: `) &&
          is_close(mpa_in(line), panels_mpa[panel]),
        line,
      );
    });
  });
  await check("motion and stress run through the data", async () => {
    for (const [id, lines] of [
      [
        "stress-motion",
        [
          [stress.rigid_motion, "pilot_deg"],
          [stress.motion, "pilot_deg"],
        ],
      ],
      ["stress-history", [[stress.history, "outside_discs_mpa"]]],
    ]) {
      const [x, y] = [await axis(by(page, id), "x"), await axis(by(page, id), "y")];
      const paths = by(page, id).locator('g[aria-label="line"] path');
      assert.equal(await paths.count(), lines.length, id);
      for (const [i, [lists, name]] of lines.entries()) {
        const path = await paths.nth(i).getAttribute("d");
        const [px, py] = path.split(/[MLC]/).at(-1).split(",").slice(-2).map(Number);
        const [time, value] = [floats(lists.time_s).at(-1), floats(lists[name]).at(-1)];
        assert.ok(Math.abs(px - x(time)) < 1 && Math.abs(py - y(value)) < 1, `${id}, line ${i}`);
      }
    }
  });
}

async function keeping_checks(page, { history }) {
  await check("stresses over time are saved as CSV", async () => {
    const [file] = await Promise.all([
      page.waitForEvent("download"),
      page.locator("#stress-history-card").getByTestId("save-csv").click(),
    ]);
    const [heads, ...rows] = (await readFile(await file.path(), "utf8")).trim().split("\r\n");
    assert.equal(heads, "time_s,outside_discs_mpa");
    const values = floats(history.outside_discs_mpa);
    assert.equal(rows.length, values.length);
    rows.forEach((row, k) => assert.ok(Math.abs(row.split(",")[1] / values[k] - 1) < 1e-6, row));
  });
  await check("on paper the charts are narrower, and the colours those of the day", async () => {
    await light_up(page, "dark");
    await page.evaluate(() => {
      window.looks = () => ({
        theme: document.documentElement.dataset.theme,
        scale: getComputedStyle(document.querySelector(".stress-scale i")).backgroundImage,
        chip: document.querySelector("#stress-panels i").style.background,
        width: Number(document.querySelector("#stress-history svg.plot").getAttribute("width")),
      });
      addEventListener("beforeprint", () => (window.printed = window.looks()));
    });
    const before = await page.evaluate(() => window.looks());
    await page.pdf();
    const printed = await page.evaluate(() => window.printed);
    assert.deepEqual([before.theme, printed.theme], ["dark", "light"]);
    assert.ok(printed.width < before.width, `${printed.width} px`);
    for (const what of ["scale", "chip"]) assert.notEqual(printed[what], before[what], what);
    assert.deepEqual(await page.evaluate(() => window.looks()), before);
    await light_up(page, "light");
  });
}

async function contact_checks(page, detail) {
  const { contact, pilot_deg } = detail,
    first = contact.first_contact;
  await check("the card says where panels first meet, or that none do", async () => {
    const words = await by(page, "contact").innerText();
    if (!first) return assert.match(words, /No two panels meet up to/);
    for (const text of [
      `At ${Number(first.pilot_deg.toFixed(4))}° two panels first meet`,
      `panels [${first.panels[0].join(", ")}] and [${first.panels[1].join(", ")}]`,
    ])
      assert.ok(words.includes(text), `no “${text}”: ${words}`);
    const is_before = first.pilot_deg < contact.deploys_from_deg;
    assert.equal(words.includes("before D"), is_before, words);
    assert.equal(words.includes("Plates of up to"), !is_before, words);
  });
  if (!first) return;
  await check("the angle is marked on the slider and in the charts", async () => {
    const [tick, track] = [
      await by(page, "mark-contact").locator("i").boundingBox(),
      await by(page, "pilot").boundingBox(),
    ];
    const k = pilot_deg.findIndex((angle) => angle >= first.pilot_deg),
      last = pilot_deg.length - 1;
    const at =
      k < 0 ? last : k - (pilot_deg[k] - first.pilot_deg) / (pilot_deg[k] - pilot_deg[k - 1]);
    const wanted = track.x + 8 + (1 - at / last) * (track.width - 16);
    assert.ok(Math.abs(tick.x + 1 - wanted) < 3, `${tick.x} for ${wanted}`);
    for (const id of ["histories", "moment"])
      assert.equal(
        await by(page, id)
          .locator("svg text", { hasText: /^contact / })
          .count(),
        1,
        id,
      );
    const frames = [];
    for (const mark of ["depth", "limit", "contact"]) {
      const words = by(page, `mark-${mark}`).locator("b");
      for (const one of await words.all()) frames.push(await one.boundingBox());
    }
    frames.sort((a, b) => a.x - b.x);
    for (const [i, frame] of frames.slice(1).entries())
      assert.ok(frame.x > frames[i].x + frames[i].width, "words of two marks lie on each other");
  });
  await check("from there on the two panels are marked", async () => {
    const k = pilot_deg.findIndex((angle) => angle >= first.pilot_deg);
    const button = by(page, "stress-button");
    if (await button.isVisible()) await button.click();
    const marked = async (sample) => {
      await go(page, sample);
      return {
        pixels: (await pixels_of(page, "contact")).count,
        said: await by(page, "met-legend").evaluate((node) => node.classList.contains("met")),
      };
    };
    const before = await marked(k < 0 ? pilot_deg.length - 1 : k - 1);
    assert.deepEqual(before, { pixels: 0, said: false }, "before");
    if (k < 0) return "beyond the last sample";
    const after = await marked(k);
    assert.ok(after.pixels > 50 && after.said, `from there on: ${JSON.stringify(after)}`);
    const is_beyond = pilot_deg[k] > detail.verdict.deploys_from_deg + 1e-9;
    assert.match(
      await by(page, "pilot-says").innerText(),
      is_beyond ? /beyond D/ : /panels in contact/,
    );
    if (await button.isVisible()) await button.click();
    assert.ok((await marked(k)).pixels > 50, "beside the stresses");
  });
}

async function report_checks(browser, report) {
  const data = data_of(report),
    [detail] = data.details;
  console.log(`\n${report}`);
  const { page, context, problems } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
    colorScheme: "light",
  });
  if (detail.stress) {
    await colour_checks(page, data, detail.stress);
    await card_checks(page, data, detail.stress);
    await keeping_checks(page, detail.stress);
  }
  await contact_checks(page, detail);
  await check("no word is missing a value, and nothing went wrong", async () => {
    assert.doesNotMatch(await page.locator("body").innerText(), /undefined|NaN|\bnull\b/);
    assert.deepEqual(problems, []);
  });
  await context.close();
}

const reports = process.argv.slice(2);
let browser = await open_browser();
for (const report of reports) await report_checks(browser, report);
await browser.close();
console.log("\nwithout WebGL");
browser = await open_browser(["--disable-3d-apis"]);
for (const report of reports.slice(0, 2)) await report_checks(browser, report);
await browser.close();
process.exit(summary() && reports.length ? 0 : 1);
