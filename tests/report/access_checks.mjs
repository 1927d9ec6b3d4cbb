// Access by keyboard and screen reader; axe-core (Deque Systems) judges.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { by, check } from "./reading.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

async function violations(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(async () => (await window.axe.run()).violations);
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120))[0]}`);
}

/** Leaves the page in the light. */
export async function access_checks(page, { details }) {
  await check("no violation of accessibility, light and dark", async () => {
    for (const scheme of ["dark", "light"]) {
      await page.emulateMedia({ colorScheme: scheme });
      assert.deepEqual(await violations(page), [], scheme);
    }
  });
  if (details.length === 0) return;
  await check("the keyboard turns the sheet and plays its deployment", async () => {
    const canvas = by(page, "folding-canvas"),
      shown = () => canvas.evaluate((node) => node.toDataURL());
    await canvas.focus();
    const before = await shown();
    await page.keyboard.press("ArrowLeft");
    assert.notEqual(await shown(), before);
    await page.keyboard.press("0");
    await by(page, "play").focus();
    await page.keyboard.press("Enter");
    assert.equal(await by(page, "play").getAttribute("aria-pressed"), "true");
    await page.keyboard.press("Enter");
    assert.equal(await by(page, "play").getAttribute("aria-pressed"), "false");
  });
}
