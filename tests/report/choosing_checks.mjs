// Around the table and the scatter: what all columns take, yields, and rows without details.
import assert from "node:assert/strict";
import { kPatience_ms } from "./browser.mjs";
import { by, eventually, state, unfiltered } from "./reading.mjs";

export async function no_detail_checks(page, data) {
  const bares = data.candidates.columns.draw.filter(
    (draw) => !data.details.some((detail) => detail.draw === draw),
  );
  if (bares.length === 0) return;
  const bare = bares.find((draw) => String(Number(draw)) !== draw) ?? bares[0]; // all of its digits count
  await unfiltered(
    page,
    "a row without details shows its metrics and the command that brings them",
    async () => {
      await by(page, "filter").fill(`draw = ${bare}`);
      await by(page, "grid").locator(".line").first().click();
      const { misalign, catalogue, choice, springs, output } = data.commands;
      const report = `${misalign} report ${catalogue} --draw ${bare}${choice}${springs} --output ${output}`;
      assert.equal(await by(page, "command-report").textContent(), report);
      assert.equal(
        await by(page, "command-replay").textContent(),
        `${misalign} replay ${catalogue} ${bare}`,
      );
      assert.ok(await by(page, "no-details").isVisible());
      assert.ok(!(await by(page, "folding").isVisible()));
      assert.equal((await state(page)).pilot_deg, null);
      const row = data.candidates.columns.draw.indexOf(bare);
      assert.ok(
        (await by(page, "metrics").textContent()).includes(
          `${(100 * data.candidates.columns.stroke_max[row]).toFixed(2)} %`,
        ),
      );
      await page.evaluate(() =>
        Object.defineProperty(navigator, "clipboard", {
          value: {
            writeText: async (text) => {
              window.copied = text;
            },
          },
        }),
      );
      await by(page, "no-details").getByTestId("copy").click();
      assert.equal(await page.evaluate(() => window.copied), report);
      await by(page, "filter").fill("");
    },
  );
  await unfiltered(
    page,
    "a button says “Copied” for a while, however often it is clicked",
    async () => {
      await by(page, "filter").fill(`draw = ${bare}`);
      await by(page, "grid").locator(".line").first().click();
      const button = by(page, "no-details").getByTestId("copy");
      await page.evaluate(() => {
        const timeout = setTimeout;
        window.later = [];
        window.setTimeout = (run, ms) =>
          ms > 1000 ? void window.later.push(run) : timeout(run, ms);
        window.time_goes_by = () => {
          for (const run of window.later) run();
          window.setTimeout = timeout;
        };
      });
      await button.dblclick();
      assert.equal(await button.textContent(), "Copied");
      await page.evaluate(() => window.time_goes_by());
      assert.equal(await button.textContent(), "Copy", "it says so for good");
    },
  );
}

/** The layout of the table, whatever is in it. */
export async function layout_checks(page, data) {
  const { columns } = data.candidates;
  await unfiltered(page, "all columns can be reached, and are seen to go on", async () => {
    const grid = by(page, "grid"),
      more = by(page, "table").locator(".side.right");
    for (const width of [2500, 800]) {
      await page.setViewportSize({ width, height: 900 });
      await eventually(
        page,
        {
          test: (narrow) => {
            const rows = document.querySelector("#table [role=grid]"),
              sign = document.querySelector("#table .side.right");
            return [rows.scrollWidth - rows.clientWidth > 1, sign.checkVisibility()].every(
              (seen) => seen === narrow,
            );
          },
          with: width === 800,
        },
        `hidden columns and the sign of them at ${width} px`,
      );
    }
    for (const end = Date.now() + kPatience_ms; (await more.isVisible()) && Date.now() < end;) {
      await more.click({ timeout: 2000 }).catch(() => {}); // it goes with the last column
      await page.evaluate(
        () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
      );
    }
    const [last, box] = [
      await by(page, "head-isometry_error_mm").boundingBox(),
      await grid.boundingBox(),
    ];
    assert.ok(last.x + last.width <= box.x + box.width + 2, "the last column stays outside");
    await page.setViewportSize({ width: 1400, height: 900 });
    await grid.evaluate((node) => (node.scrollLeft = 0));
    for (const { width, text } of await grid
      .locator(".line")
      .first()
      .locator("> div")
      .evaluateAll((nodes) =>
        nodes.map((node) => ({
          width: node.scrollWidth - node.clientWidth,
          text: node.textContent,
        })),
      ))
      assert.ok(width <= 0, `“${text}” is cut off`);
  });
  await unfiltered(page, "one candidate is one candidate", async () => {
    await by(page, "filter").fill(`draw = ${columns.draw[0]}`);
    assert.match(await page.locator("#scatter-note").textContent(), /^1 candidate shown/);
  });
}

/** The results of `misalign tolerance`, if there are any. */
export async function yield_checks(page, data) {
  const { columns } = data.candidates;
  if (!columns.yield) return; // a catalogue from before it was kept
  const head = by(page, "head-yield"),
    tried = columns.draw.filter((_, i) => columns.yield[i] !== null);
  await unfiltered(page, "yields of miscut copies are a column where there are any", async () => {
    assert.equal(await head.count(), tried.length ? 1 : 0);
    if (tried.length === 0) return "none";
    await head.locator("button").click();
    const first = await by(page, "grid").locator(".line").first().getAttribute("data-draw"),
      most = Math.max(...columns.yield.filter((share) => share !== null));
    assert.equal(columns.yield[columns.draw.indexOf(first)], most, "the largest yield first");
    await by(page, "head-rank").locator("button").click();
    return `${tried.length} candidates`;
  });
  await unfiltered(page, "and stand in the candidate's card with what was tried", async () => {
    for (const draw of [...tried.slice(0, 1), columns.draw.find((one) => !tried.includes(one))]) {
      await by(page, "filter").fill(`draw = ${draw}`);
      await by(page, "grid").locator(".line").first().click();
      const entries = data.yields.filter((entry) => entry.draw === draw),
        words = await by(page, "yields").textContent();
      assert.equal(await by(page, "yields").isVisible(), entries.length > 0);
      for (const { amplitude_mm, survivors, trials } of entries)
        assert.ok(
          words.includes(`At ±${amplitude_mm} mm ${survivors} of ${trials} miscut copies`),
          words,
        );
    }
  });
}

/** The results of `misalign certify`, if there are any. */
export async function certificate_checks(page, data) {
  const { columns } = data.candidates,
    of = (draw) => data.certificates.find((entry) => entry.draw === draw),
    with_one = columns.draw.filter(of);
  await unfiltered(page, "certified angles are a column where there are any", async () => {
    assert.equal(await by(page, "head-certified_deg").count(), with_one.length ? 1 : 0);
    return with_one.length ? `${with_one.length} candidates` : "none";
  });
  await unfiltered(page, "and stand in the candidate's card, never rounded up", async () => {
    for (const draw of [...with_one.slice(0, 1), columns.draw.find((one) => !of(one))]) {
      if (draw === undefined) continue;
      await by(page, "filter").fill(`draw = ${draw}`);
      await by(page, "grid").locator(".line").first().click();
      const box = by(page, "certificate"),
        entry = of(draw);
      assert.equal(await box.isVisible(), Boolean(entry));
      if (!entry) continue;
      const [, angle, end, intervals] = (await box.textContent()).match(
        /^Certified to ([\d.]+)° \((\w+)[^,]*, (\d+) intervals?/,
      );
      assert.ok(
        Number(angle) <= entry.certified_deg && Number(angle) > entry.certified_deg - 0.011,
      );
      assert.deepEqual([end, Number(intervals)], [entry.end, entry.intervals]);
    }
  });
}
