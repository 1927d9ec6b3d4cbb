// A report's words on its campaign: figures, faults, whose folding it carries.
import assert from "node:assert/strict";
import { by, check } from "./reading.mjs";

/** Every panel has a mark that says its page of the manual. */
async function manual_check(page) {
  await check("every panel names its page of the manual", async () => {
    const panels = await page
      .locator("main .card h3, main .part h2")
      .evaluateAll((headings) =>
        headings.map((heading) => [
          heading.dataset.manual,
          heading.nextElementSibling?.title,
          heading.textContent,
        ]),
      );
    for (const [file, title, words] of panels)
      assert.ok(file && title?.includes(file.replace(/^search\/manual\/|\.md$/g, "")), words);
    return `${panels.length} panels`;
  });
}

export async function figures_check(page, data) {
  await manual_check(page);
  await check("campaign, draws and acceptance are shown", async () => {
    assert.equal(await by(page, "campaign").textContent(), data.campaign.name);
    const figures = await by(page, "figures").textContent();
    for (const [term, number] of [
      ["Draws", data.state.draws],
      ["Accepted", data.state.accepted],
      ["Undecided", data.state.undecided],
    ]) {
      const tile = by(page, "figures").locator("div", {
        has: page.getByText(term, { exact: true }),
      });
      assert.equal(await tile.locator("strong").textContent(), number.toLocaleString("en"), term);
    }
    const asked = await by(page, "asked").textContent(),
      { accept, misalignment } = data.campaign.configuration;
    assert.ok(
      asked.includes(`${accept.deploys_from_deg}°`) &&
        asked.includes(`${misalignment.amplitude_mm} mm`),
      asked,
    );
    if (accept.stops_at_deg) {
      const stiffness = accept.stop_stiffness_mm2_per_rad2 * data.actuators.stiffness_n_per_mm;
      assert.ok(
        asked.includes(`relaxed at ${accept.stops_at_deg}°`) &&
          asked.includes(`at least ${stiffness.toPrecision(3)} N mm/rad`),
        asked,
      );
    }
    if (data.state.acceptance.rate > 0)
      assert.match(figures, /Acceptance rate[\d.,]+ %95 %: [\d.,]+ % – [\d.,]+ %/);
  });
}

async function sample_check(page, { faults }) {
  await check("the sample's size and weight are said", async () => {
    const note = await by(page, "sample-note").textContent(),
      sampled = faults.rows.reduce((total, row) => total + row.sampled, 0);
    assert.ok(note.includes(sampled.toLocaleString("en")), "the sample's size");
    assert.ok(note.includes("1,024"), "one draw in 1,024");
    if (faults.every_at_most > 1024)
      assert.ok(
        note.includes(faults.every_at_most.toLocaleString("en")),
        "how many draws the later rows stand for",
      );
  });
}

async function legend_check(page, { faults }) {
  await check("every first fault has words and a colour", async () => {
    const words = await page
      .locator("#faults-caption .legend li")
      .evaluateAll((items) =>
        items.map((item) => [
          item.textContent,
          item.title,
          getComputedStyle(item.querySelector("i")).backgroundColor,
        ]),
      );
    for (const [short, long, colour] of words) {
      assert.ok(!/_/.test(short + long) && long.length > short.length, `words for ${short}`);
      assert.notEqual(colour, "rgba(0, 0, 0, 0)", `a colour for ${short}`);
    }
    const names = faults.rows.map((row) => row.first_fault).filter((name) => name !== "none");
    assert.equal(words.length, new Set(names).size, "faults with words");
  });
}

/** The place that a chart shows as the first, and the map as the strongest. */
async function place_check(page, { faults }) {
  const places = new Map();
  for (const { where, weight } of faults.rows)
    if (where) places.set(where, (places.get(where) ?? 0) + weight);
  if (places.size === 0) return;
  await check(
    "the place where most fail is the first bar and the map's strongest line",
    async () => {
      const most = Math.max(...places.values());
      const first = await by(page, "where")
        .locator('g[aria-label^="y-axis tick label"] text')
        .first()
        .textContent();
      assert.equal(places.get(first.replace("–", "-")), most, `the first bar, ${first}`);
      const widest = await by(page, "map")
        .locator("[data-where]")
        .evaluateAll(
          (nodes) =>
            nodes
              .map((node) => [parseFloat(node.style.strokeWidth), node.dataset.where])
              .sort((a, b) => b[0] - a[0])[0][1],
        );
      assert.equal(places.get(widest), most, `the map's strongest line, ${widest}`);
    },
  );
}

export async function faults_checks(page, data) {
  const { rows } = data.faults;
  if (rows.length === 0) return;
  await sample_check(page, data);
  await legend_check(page, data);
  await check("a bar for each fault and angle, and the survival", async () => {
    const width_deg = Math.max(5, data.campaign.configuration.path.sample_deg);
    const bins = rows
      .filter((row) => row.fault_deg !== null && row.first_fault !== "none")
      .map((row) => `${row.first_fault} ${Math.ceil(row.fault_deg / width_deg)}`);
    const bars = by(page, "faults").locator('g[aria-label="rect"] rect');
    assert.equal(await bars.count(), new Set(bins).size, "bars");
    assert.ok(await by(page, "survival").locator("svg").count(), "survival");
    assert.match(await page.locator("#faults-caption").textContent(), /: [\d,]+ sampled draws?\./);
  });
  await place_check(page, data);
}

export async function carried_check(page, data) {
  await check("whose folding it carries is said", async () => {
    const note = await by(page, "candidates-note").textContent();
    const noun = data.state.ladder ? "sheet" : "draw";
    assert.match(note, new RegExp(` ${data.details.length} ${noun}s with all details`));
    const { where, diverse } = data.chosen;
    if (where) assert.ok(note.includes(where), note);
    if (diverse) assert.ok(note.includes(`a spread of ${diverse}`), note);
  });
}

export async function emptiness_check(page) {
  await check("without candidates a sentence says what to do", async () => {
    assert.match(
      await by(page, "candidates-note").textContent(),
      /search again|Run the same search/,
    );
    assert.ok(!(await page.locator("#chooser").isVisible()));
  });
}
