// The page of a pattern file: one sheet, no campaign.
//   node pattern_test.mjs REPORT.html...
import assert from "node:assert/strict";
import { open_browser, open_page } from "./browser.mjs";
import { by, check, data_of, state, summary } from "./reading.mjs";

const reports = process.argv.slice(2);
const browser = await open_browser();
for (const report of reports) {
  const data = data_of(report),
    [detail] = data.details;
  console.log(`\n${report}: ${data.pattern.name}`);
  const { page, context, problems } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
  });
  await check("the pattern is named, and what only a campaign has is not there", async () => {
    assert.equal(await by(page, "campaign").textContent(), data.pattern.name);
    assert.equal(await by(page, "picked").textContent(), data.pattern.name);
    const shifted = Object.keys(detail.displacements_mm).length;
    const asked = await by(page, "asked").textContent();
    assert.ok(asked.includes(`${data.sheet.panels.length} panels`), asked);
    assert.ok(
      asked.includes(shifted ? `${shifted} vertices shifted` : "no vertex is shifted"),
      asked,
    );
    for (const id of [
      "figures",
      "faults",
      "survival",
      "where",
      "map",
      "table",
      "scatter",
      "filter",
    ]) {
      assert.equal(await by(page, id).isVisible(), false, `${id} is shown`);
    }
    assert.equal(await page.locator('nav a[href="#candidates"]').isVisible(), false);
  });
  await check("the verdict says nothing of acceptance", async () => {
    const words = await by(page, "picked-words").textContent();
    const { deploys_from_deg } = detail.verdict;
    assert.ok(words.includes(deploys_from_deg > 0 ? `${deploys_from_deg}°` : "any angle"), words);
    assert.doesNotMatch(words, /accepted/i);
  });
  await check("crease pattern, folding, histories and springs are there", async () => {
    for (const id of ["crease-pattern", "folding", "histories", "energy", "moment", "advantage"]) {
      assert.ok(await by(page, id).isVisible(), `${id} is hidden`);
      assert.ok(await by(page, id).locator("svg, canvas").count(), `${id} is empty`);
    }
    assert.equal((await state(page)).picked, data.pattern.name);
  });
  await check("the folding opens at the angle of use, which is marked", async () => {
    const { from_deg } = detail;
    if (from_deg !== null) assert.equal((await state(page)).pilot_deg, from_deg);
    const marks = await page.locator(".mark.used").allTextContents();
    const is_marked = from_deg !== null && from_deg < detail.verdict.deploys_from_deg;
    assert.deepEqual(marks, is_marked ? [`used from ${from_deg}°`] : []);
  });
  await check("commands are about the file", async () => {
    const commands = await by(page, "commands").locator("code").allTextContents();
    const has = (verb) => commands.some((command) => command.includes(` ${verb} `));
    for (const verb of ["fold", "verify", "export", "actuators"])
      assert.ok(has(verb), `no command ${verb}`);
    // A sheet that deploys from nowhere has nothing that miscut copies could lose.
    assert.equal(has("tolerance"), detail.verdict.deploys_from_deg > 0, "command tolerance");
    for (const command of commands) {
      assert.ok(command.includes(` ${data.commands.catalogue}`), command);
      assert.doesNotMatch(command, /--draw|replay/);
    }
  });
  await check("nothing speaks of what only a campaign has", async () => {
    assert.doesNotMatch(await by(page, "actuation").textContent(), /campaign/);
    assert.doesNotMatch(await by(page, "metrics").textContent(), /miscut/);
  });
  await check("there is no card of what was not asked for", async () => {
    for (const id of [
      "contact",
      "stress-card",
      "stress-motion",
      "stress-history",
      "stress-scale",
      "stress-button",
      "met-legend",
    ])
      assert.equal(await by(page, id).isVisible(), false, `${id} is shown`);
  });
  await check("the fold limit is named where no line is", async () => {
    const { fold_limit_deg, verdict } = detail;
    if (!(fold_limit_deg < 165)) return; // else there is no room
    for (const id of ["histories", "energy", "moment", "advantage"]) {
      const [words, depth] = await Promise.all(
        [/^fold limit/, `D = ${verdict.deploys_from_deg}°`].map((text) =>
          by(page, id).locator("svg text", { hasText: text }).boundingBox(),
        ),
      );
      assert.ok(
        words.x + words.width < depth.x - 5,
        `${id}: the fold limit's words lie on the lines`,
      );
    }
  });
  await check("commands break between words, and lists show all of a small sheet", async () => {
    for (const width of [500, 800, 1000, 1250, 1500]) {
      await page.setViewportSize({ width, height: 900 });
      const broken = await by(page, "commands").evaluate((box) =>
        [...box.querySelectorAll("code")].flatMap((code) => {
          const walker = document.createTreeWalker(code, NodeFilter.SHOW_TEXT),
            words = [];
          while (walker.nextNode()) {
            for (const { index, 0: word } of walker.currentNode.data.matchAll(
              /(?<!\S)\S{1,40}(?!\S)/g,
            )) {
              const range = new Range();
              range.setStart(walker.currentNode, index);
              range.setEnd(walker.currentNode, index + word.length);
              const tops = [...range.getClientRects()].map(({ top }) => Math.round(top));
              if (new Set(tops).size > 1) words.push(word);
            }
          }
          return words;
        }),
      );
      assert.deepEqual(broken, [], `${width} px`);
      const cut = await by(page, "diagonals").evaluate(
        (box) => box.scrollHeight - box.clientHeight,
      );
      assert.ok(cut <= 0, `${width} px: ${cut} px of the diagonals' list are out of sight`);
    }
  });
  await check("no word is missing a value, and nothing went wrong", async () => {
    const text = await page.locator("body").innerText();
    assert.doesNotMatch(text, /undefined|NaN|\bnull\b|\bdraw\b/i);
    assert.deepEqual(problems, []);
  });
  await context.close();
}
await browser.close();
process.exit(summary() && reports.length ? 0 : 1);
