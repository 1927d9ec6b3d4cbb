// Two candidates side by side: numbers as the data have them, the better of each two, the address.
import assert from "node:assert/strict";
import { by, check } from "./reading.mjs";

const row_of = (page, name) => by(page, "beside").locator(`tr[data-metric="${name}"]`);

export async function beside_checks(page, { candidates: { columns, shown }, details }) {
  if (shown < 2) return;
  await check("two candidates side by side", async () => {
    const held = details.find(({ draw }) => columns.draw.includes(draw))?.draw ?? columns.draw[0],
      other = columns.draw.find((draw) => draw !== held);
    const is_kept = (draw) => new URLSearchParams(location.hash.slice(1)).get("beside") === draw;
    const pick = async (draw) => {
      await page.evaluate((hash) => (location.hash = hash), `draw=${draw}`);
      await page.waitForFunction((wanted) => window.misalign.picked === wanted, draw);
    };
    assert.equal(await by(page, "beside").locator("tr").count(), 0);
    await pick(held);
    await by(page, "hold-choice").selectOption(held);
    await page.waitForFunction(is_kept, held);
    assert.equal(await by(page, "hold-choice").inputValue(), held);
    await page.evaluate(
      (draw) => (location.hash = `beside=${draw[0]}&draw=${draw[1]}`),
      [held, other],
    );
    await page.waitForFunction((wanted) => window.misalign.picked === wanted, other);
    const heads = await by(page, "beside").locator("thead th").allTextContents();
    assert.ok(heads[1].endsWith(` ${other}`) && heads[2].endsWith(` ${held}`), heads.join());
    for (const [name, less_is_better] of [
      ["stroke_max", true],
      ["deploys_from_deg", false],
    ]) {
      const values = [other, held].map((draw) => columns[name][columns.draw.indexOf(draw)]);
      const cells = row_of(page, name).locator("td");
      const numbers = (await cells.allTextContents()).map((text) => Number.parseFloat(text));
      const shown_as = name === "stroke_max" ? 100 : 1;
      numbers.forEach((number, k) =>
        assert.ok(Math.abs(number - shown_as * values[k]) <= 0.5, name),
      );
      const classes = await cells.evaluateAll((nodes) =>
        nodes.map((node) => node.className === "better"),
      );
      const first = values[0] < values[1] === less_is_better;
      assert.deepEqual(classes, values[0] === values[1] ? [false, false] : [first, !first], name);
    }
    const has_details = details.some(({ draw }) => draw === held);
    for (const id of ["beside-histories", "held-folding"])
      assert.equal(await by(page, id).isVisible(), has_details, id);
    assert.equal(
      await row_of(page, "shifted_vertices").locator(".better").count(),
      0,
      "no number of vertices is better",
    );
    await by(page, "release").click();
    assert.equal(await by(page, "beside").locator("tr").count(), 0);
    await page.waitForFunction(() => !location.hash.includes("beside"));
    return `${held} and ${other}`;
  });
}
