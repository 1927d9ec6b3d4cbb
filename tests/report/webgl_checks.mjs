// The folding picture where WebGL's context is lost, or cannot be made.
import assert from "node:assert/strict";
import { open_page } from "./browser.mjs";
import { by, check, pixels } from "./reading.mjs";

/** Loses the context, as a driver that is replaced does, and gives it back. */
export async function context_check(page) {
  await check("a lost context is restored, and the sheet drawn again", async () => {
    const canvas = by(page, "folding-canvas"),
      before = await pixels(canvas);
    await canvas.evaluate(async (node) => {
      window.loss = node.getContext("webgl2").getExtension("WEBGL_lose_context");
      const lost = new Promise((done) => node.addEventListener("webglcontextlost", done));
      window.loss.loseContext();
      await lost;
    });
    assert.equal((await pixels(canvas)).covered, 0, "the context is not lost");
    await canvas.evaluate(async (node) => {
      const restored = new Promise((done) => node.addEventListener("webglcontextrestored", done));
      window.loss.restoreContext();
      await restored;
    });
    assert.deepEqual(await pixels(canvas), before);
  });
}

/** The browser has WebGL, but no context is left for the folding: none, or one that is lost. */
export async function no_context_check(browser, report) {
  for (const kind of ["none", "lost"])
    await check(`context of the folding: ${kind}`, async () => {
      const { page, context, problems } = await open_page(browser, report);
      await page.addInitScript((which) => {
        const make = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (name, ...more) {
          const ours = name === "webgl2" && this.dataset.testid;
          if (ours && which === "none") return null;
          const made = make.call(this, name, ...more);
          if (ours) made.getExtension("WEBGL_lose_context").loseContext();
          return made;
        };
      }, kind);
      await page.reload();
      await page.waitForFunction(() => window.misalign !== undefined);
      assert.match(await page.locator("#folding-caption").textContent(), /no WebGL/);
      assert.ok((await pixels(by(page, "folding-canvas"))).colours > 4);
      assert.deepEqual(problems, []);
      await context.close();
    });
}
