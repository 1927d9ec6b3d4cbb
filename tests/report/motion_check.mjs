// A page whose reader wants motion: the sheet moves by itself, until the reader stops it at an angle.
import assert from "node:assert/strict";
import { open_page } from "./browser.mjs";
import { by, check, data_of, floats, state } from "./reading.mjs";

/** Waits until pictures have been drawn, or not for a while. */
async function moves(page) {
  const count = () => page.evaluate(() => window.misalign.pictures);
  const before = await count();
  for (let trial = 0; trial < 20; ++trial) {
    await page.waitForTimeout(150);
    if ((await count()) > before + 1) return true;
  }
  return false;
}

/** Waits until the address names the angle of the sheet. */
async function keeps_angle(page) {
  const { pilot_deg } = await state(page);
  await page.waitForFunction(
    (at) => new URLSearchParams(location.hash.slice(1)).get("at") === at,
    String(pilot_deg),
  );
  return pilot_deg;
}

/** The sheet that takes longest, 20 times slower, is stopped on its way. */
export async function real_time_check(browser, report) {
  await check("the address follows a sheet that deploys in real time", async () => {
    const end_s = ({ let_go }) => (let_go ? floats(let_go.time_s).at(-1) : 0),
      [longest] = data_of(report).details.sort((a, b) => end_s(b) - end_s(a));
    const { page, context, problems } = await open_page(browser, report);
    await by(page, "detailed").selectOption(longest.draw);
    await by(page, "mark-flat").click();
    assert.equal(await keeps_angle(page), 0);
    await by(page, "let-go-slowly").check();
    await by(page, "let-go-play").click();
    await page.waitForFunction(() => window.misalign.pilot_deg !== 0);
    await by(page, "let-go-play").click();
    assert.notEqual(await keeps_angle(page), 0);
    await by(page, "let-go-play").click();
    await page.waitForFunction(() => !location.hash.includes("at="));
    assert.deepEqual(problems, []);
    await context.close();
  });
}

export async function motion_check(browser, report) {
  await check(
    "the sheet moves by itself until it is stopped, and the address keeps where",
    async () => {
      const { page, context, problems } = await open_page(browser, report, {
        reducedMotion: "no-preference",
      });
      assert.ok(await moves(page), "it rests");
      assert.equal(await by(page, "play").getAttribute("aria-pressed"), "true");
      await by(page, "mark-depth").click();
      const pilot_deg = await keeps_angle(page);
      assert.equal(await moves(page), false, "it moves on");
      await page.reload();
      await page.waitForFunction(() => window.misalign !== undefined);
      assert.equal((await state(page)).pilot_deg, pilot_deg);
      assert.equal(await moves(page), false, "it moves, though it was stopped");
      await by(page, "play").click();
      assert.ok(await moves(page), "it does not play");
      await page.waitForFunction(() => !location.hash.includes("at="));
      assert.deepEqual(problems, []);
      await context.close();
    },
  );
}
