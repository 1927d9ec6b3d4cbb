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

async function narrow_check(page) {
  await check("a narrow window needs no sideways scrolling", async () => {
    await page.setViewportSize({ width: 800, height: 900 });
    await eventually(
      page,
      { test: () => innerWidth === 800 && document.documentElement.scrollWidth <= innerWidth },
      "wider than the window",
    );
  });
}

export async function looks_checks(page, shown) {
  await theme_check(page);
  await print_check(page, shown);
  await narrow_check(page);
}
