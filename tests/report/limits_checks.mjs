// Sliders of limits, and offers of columns that the page lacks.
import assert from "node:assert/strict";
import { by, state, unfiltered } from "./reading.mjs";

/** A column that the page lacks is offered with the command that adds it. */
async function missing_check(page, { candidates: { columns }, commands }) {
  await unfiltered(page, "a column that the page lacks comes with its command", async () => {
    const { misalign, catalogue, choice, springs, output } = commands;
    const command = (name) =>
      `${misalign} report ${catalogue} --column ${name}${choice}${springs} --output ${output}`;
    await page.getByText("Choose columns").click();
    const names = await page
      .locator('#columns-menu [data-testid^="missing-"]')
      .evaluateAll((nodes) => nodes.map((node) => node.dataset.testid.slice("missing-".length)));
    assert.ok(names.includes("static_friction_n_mm_per_mm"), names.join());
    for (const name of names) {
      assert.ok(!columns[name]?.some((value) => value !== null), `the page has ${name}`);
      await by(page, `missing-${name}`).click();
      const offer = page.locator("#columns-menu").getByTestId(`offer-${name}`);
      if (columns[name]) assert.match(await offer.textContent(), /No candidate .* has a value/);
      else assert.equal(await offer.locator("code").textContent(), command(name));
    }
    await page.getByText("Choose columns").click();
    await by(page, "filter").fill("static_friction_n_mm_per_mm > 0.1");
    const offer = by(page, "filter-says").getByTestId("offer-static_friction_n_mm_per_mm");
    await page.evaluate(() =>
      Object.defineProperty(navigator, "clipboard", {
        configurable: true,
        value: { writeText: async (text) => void (window.copied = text) },
      }),
    );
    await offer.getByTestId("copy").click();
    assert.equal(await page.evaluate(() => window.copied), command("static_friction_n_mm_per_mm"));
    await by(page, "filter").fill("");
    return `${names.length} columns`;
  });
}

/** The sliders write conditions, and what is typed moves them. */
async function limit_check(page, { candidates: { columns } }) {
  await unfiltered(page, "a slider leaves the candidates that suffice", async () => {
    const said = [];
    for (const name of ["deploys_from_deg", "critical_friction_n_mm_per_mm"]) {
      const slider = by(page, `limit-${name}`),
        values = columns[name]?.filter((value) => value !== null) ?? [];
      assert.equal(await slider.count(), new Set(values).size > 1 ? 1 : 0, name);
      if (new Set(values).size <= 1) continue;
      await slider.fill("100");
      const typed = await by(page, "filter").inputValue(),
        least = Number(typed.split(" >= ")[1]);
      assert.ok(typed.startsWith(`${name} >= `), typed);
      assert.equal(
        (await state(page)).filtered,
        values.filter((value) => value >= least).length,
        typed,
      );
      await by(page, "filter").fill(`stroke_max < 5 % ${name} >= ${Math.max(...values)}`);
      assert.equal(await slider.inputValue(), "200");
      await slider.fill("0");
      assert.equal(await by(page, "filter").inputValue(), "stroke_max < 5 %");
      await by(page, "filter").fill("");
      said.push(name);
    }
    return said.join(", ");
  });
}

export async function limits_checks(page, data) {
  await limit_check(page, data);
  await missing_check(page, data);
}
