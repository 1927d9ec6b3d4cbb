// Looks of a page: by day and night, on paper, in a narrow window.
import assert from "node:assert/strict";
import { by, check, eventually } from "./reading.mjs";

async function theme_check(page) {
  await check("light and dark, by the system and by the button", async () => {
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.emulateMedia({ colorScheme: "dark" });
    await eventually(
      page,
      { test: (was) => getComputedStyle(document.body).backgroundColor !== was, with: light },
      "the system's change is not followed",
    );
    const dark = await ground();
    await by(page, "theme").click();
    assert.equal(await ground(), light);
    await page.reload();
    assert.equal(await ground(), light, "the choice is not remembered");
    await by(page, "theme").click();
    assert.equal(await ground(), dark);
  });
}

async function print_check(page, shown) {
  await check(
    "prints light, wide and long enough for paper, and returns to what it was",
    async () => {
      await page.evaluate(() => {
        window.looks = () => ({
          theme: document.documentElement.dataset.theme,
          rows: document.querySelectorAll(".line").length,
          widths: [...document.querySelectorAll("svg.plot")].map((svg) =>
            Number(svg.getAttribute("width")),
          ),
        });
        addEventListener("beforeprint", () => (window.printed = looks()));
      });
      const looks = () => page.evaluate(() => window.looks());
      const before = await looks();
      assert.equal(before.theme, "dark");
      const pdf = await page.pdf();
      assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
      const printed = await page.evaluate(() => window.printed);
      assert.equal(printed.theme, "light");
      assert.equal(printed.rows, Math.min(shown, 50), "rows on paper");
      assert.equal(printed.widths.length, before.widths.length);
      printed.widths.forEach((width, i) => assert.ok(width < before.widths[i], `chart ${i}`));
      assert.deepEqual(await looks(), before);
      return `${(pdf.length / 1024).toFixed(0)} KiB`;
    },
  );
}

const kWidths_px = [800, 390];

async function narrow_check(page) {
  await check("a narrow window needs no sideways scrolling", async () => {
    for (const width of kWidths_px) {
      await page.setViewportSize({ width, height: 900 });
      await eventually(
        page,
        {
          test: (wide) => innerWidth === wide && document.documentElement.scrollWidth <= innerWidth,
          with: width,
        },
        `wider than ${width} px`,
      );
    }
  });
}

/** Those of every sheet with details, in a window of any width. */
async function marks_check(page) {
  await check("words of the slider's marks do not overlap", async () => {
    const draws = await page
      .getByTestId("detailed")
      .locator("option:enabled")
      .evaluateAll((all) => all.map((o) => o.value));
    for (const width of [...kWidths_px, 1400]) {
      await page.setViewportSize({ width, height: 900 });
      for (const draw of draws) {
        await by(page, "detailed").selectOption(draw);
        const boxes = await page
          .locator(".marks b")
          .evaluateAll((all) => all.map((words) => words.getBoundingClientRect().toJSON()));
        boxes.sort((a, b) => a.left - b.left);
        boxes
          .slice(1)
          .forEach(({ left }, i) => assert.ok(left >= boxes[i].right, `draw ${draw}, ${width} px`));
      }
    }
    return `${draws.length} sheets`;
  });
}

export async function looks_checks(page, shown, has_marks) {
  await theme_check(page);
  await print_check(page, shown);
  await narrow_check(page);
  if (has_marks) await marks_check(page);
}
