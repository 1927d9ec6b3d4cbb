// A page of a campaign with a design, which is another page with a design put into its data.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { open_page } from "./browser.mjs";
import { by, check, data_of, median, state } from "./reading.mjs";

const kFriction_n_mm_per_mm = 0.02;

/** The data with a design, and with a critical friction from 0 to 0.04 in another order. */
function with_design(data) {
  const { columns } = data.candidates,
    { design } = data.campaign.configuration;
  design.from_deg = median(columns.deploys_from_deg);
  design.hinges.friction_n_mm_per_mm = kFriction_n_mm_per_mm;
  columns.critical_friction_n_mm_per_mm = columns.draw.map(
    (_, k) => (2 * kFriction_n_mm_per_mm * ((k * 7919) % 1000)) / 999,
  );
  return data;
}

function write_page(report, data, file) {
  const text = readFileSync(report, "utf8"),
    open = '<script type="application/json" id="report-data">',
    start = text.indexOf(open) + open.length;
  const json = JSON.stringify(data).replaceAll("<", "\\u003c");
  writeFileSync(file, text.slice(0, start) + json + text.slice(text.indexOf("</script>", start)));
}

/** The filter begins with the design's conditions, and the sliders with its values. */
export async function design_check(browser, report) {
  const directory = mkdtempSync(join(tmpdir(), "misalign-design-")),
    file = join(directory, "designed.html"),
    data = with_design(data_of(report));
  write_page(report, data, file);
  await check("a design's angle and friction are where the sliders begin", async () => {
    const { columns } = data.candidates,
      { from_deg } = data.campaign.configuration.design;
    const { page, context, problems } = await open_page(browser, file);
    const filter = by(page, "filter");
    const conditions = `deploys_from_deg >= ${from_deg} critical_friction_n_mm_per_mm >= ${kFriction_n_mm_per_mm}`;
    assert.equal(await filter.inputValue(), conditions);
    const held = columns.draw.filter(
      (_, i) =>
        columns.deploys_from_deg[i] >= from_deg &&
        columns.critical_friction_n_mm_per_mm[i] >= kFriction_n_mm_per_mm,
    ).length;
    assert.equal((await state(page)).filtered, held);
    const slider = by(page, "limit-critical_friction_n_mm_per_mm");
    const places = Math.ceil(200 / columns.draw.length); // of the slider, from one value to the next
    assert.ok(Math.abs((await slider.inputValue()) - 100) <= places);
    const words = await page.locator("#limits output").allTextContents();
    for (const text of words) assert.match(text, /, of the design$/);
    await slider.fill("0");
    assert.equal(await filter.inputValue(), `deploys_from_deg >= ${from_deg}`);
    // The address keeps that there is no condition.
    await page.locator("#filter-clear").click();
    assert.equal((await state(page)).filtered, columns.draw.length);
    await page.waitForFunction(() => location.hash.includes("filter="));
    await page.reload();
    await page.waitForFunction(() => window.misalign !== undefined);
    assert.equal(await filter.inputValue(), "");
    assert.deepEqual(problems, []);
    await context.close();
    return `${held} of ${columns.draw.length}`;
  });
  rmSync(directory, { recursive: true });
}
