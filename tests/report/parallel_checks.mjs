// Parallel coordinates and the front, against the data of the page.
import assert from "node:assert/strict";
import { by, eventually, state, unfiltered } from "./reading.mjs";

const kSide = 46, // where the first and the last axis are, and its ends
  kTop = 46,
  kBottom = 276;

const known = (columns, name) => columns[name].filter((value) => value !== null);

/** Drags along the axis of that metric from one share of its height to another; none: a click. */
async function brush(page, name, from, to) {
  const canvas = by(page, "parallel-canvas");
  await canvas.scrollIntoViewIfNeeded();
  const box = await canvas.boundingBox(),
    axes = (await canvas.getAttribute("data-axes")).split(" "),
    x = box.x + kSide + (axes.indexOf(name) * (box.width - 2 * kSide)) / (axes.length - 1),
    y = (share) => box.y + kBottom - share * (kBottom - kTop);
  await page.mouse.move(x, y(from));
  await page.mouse.down();
  await page.mouse.move(x, y((from + to) / 2));
  await page.mouse.move(x, y(to));
  await page.mouse.up();
}

const filter_is = (page, test, what) =>
  eventually(
    page,
    { test: (words) => document.getElementById("filter").value === words, with: test },
    what,
  );

async function brush_check(page, { candidates: { columns, total } }) {
  if (!(await by(page, "parallel").isVisible())) return;
  await unfiltered(page, "a brush on an axis is a condition of the filter", async () => {
    const axes = (await by(page, "parallel-canvas").getAttribute("data-axes")).split(" ");
    for (const name of axes)
      assert.ok(new Set(known(columns, name)).size > 1, `${name} says nothing`);
    const name = axes.includes("stroke_max") ? "stroke_max" : axes[0],
      [least, most] = [Math.min(...known(columns, name)), Math.max(...known(columns, name))],
      is_log = least > 0 && most / least > 1000,
      at = (share) => (is_log ? least * (most / least) ** share : least + share * (most - least));
    await brush(page, name, 0.25, 0.75);
    const words = await by(page, "filter").inputValue(),
      [, low, high] =
        new RegExp(`^${name} >= (\\S+) ${name} <= (\\S+)$`).exec(words) ?? assert.fail(words);
    const near = (a, b) =>
      Math.abs(a - b) <= 0.02 * (is_log ? b : most - least) + 0.005 * Math.abs(b);
    assert.ok(
      near(Number(low), at(0.25)) && near(Number(high), at(0.75)),
      `${words}: not ${at(0.25)} to ${at(0.75)}`,
    );
    const held = columns[name].filter(
      (v) => v !== null && v >= Number(low) && v <= Number(high),
    ).length;
    assert.equal((await state(page)).filtered, held);
    assert.equal(
      await by(page, "parallel-where").textContent(),
      `--where "${name} >= ${low} AND ${name} <= ${high}"`,
    );
    // To the end of the axis there is no bound; another axis has its own; a click takes one away.
    await brush(page, name, 0.5, 1.1);
    const upper = await by(page, "filter").inputValue();
    assert.match(upper, new RegExp(`^${name} >= \\S+$`));
    const other = axes.find((one) => one !== name);
    await brush(page, other, -0.05, 0.5);
    assert.match(
      await by(page, "filter").inputValue(),
      new RegExp(`^${name} >= \\S+ ${other} <= \\S+$`),
    );
    await brush(page, other, 0.3, 0.3);
    await filter_is(page, upper, "the condition stays");
    await brush(page, name, 0.3, 0.3);
    await filter_is(page, "", "a condition stays");
    return `${axes.length} axes, ${held} of ${total}`;
  });
}

async function front_check(page, { candidates: { columns } }) {
  await unfiltered(page, "the front is of those than which none is better in both", async () => {
    await by(page, "scatter-x").selectOption("stroke_max"); // less is better
    await by(page, "scatter-y").selectOption("slope_min_mm_per_deg"); // more is
    await by(page, "scatter-front").check();
    const rows = columns.draw
      .map((_, k) => [columns.stroke_max[k], columns.slope_min_mm_per_deg[k]])
      .filter(([a, b]) => a !== null && b !== null)
      .sort(([a, b], [c, d]) => a - c || d - b);
    let best = -Infinity,
      last = null,
      front = 0;
    for (const [stroke, slope] of rows) {
      const is_equal = last && last[0] === stroke && last[1] === slope;
      if (slope > best || is_equal) {
        ++front;
        [best, last] = [slope, [stroke, slope]];
      }
    }
    const said = await page.locator("#scatter-note").textContent();
    assert.ok(
      said.includes(`Line: Pareto front of ${front.toLocaleString("en-US")} candidate`),
      `${front}: ${said}`,
    );
    await by(page, "scatter-front").uncheck();
    assert.doesNotMatch(await page.locator("#scatter-note").textContent(), /Pareto front/);
    return `${front}`;
  });
}

/** Of a search that made draws better: what each was worth, and the draw beside what it became. */
async function ascent_check(page, { details, candidates: { columns } }) {
  // What a population found is not stored, so that it cannot be held.
  const made = details.find(
    ({ ascent, draw }) => ascent?.steps > 0 && ascent.start && columns.draw.includes(draw),
  );
  if (!made) return;
  await unfiltered(page, "a sheet beside the draw that it was made of", async () => {
    await page.evaluate((draw) => (location.hash = `draw=${draw}`), made.draw);
    await page.waitForFunction((wanted) => window.misalign.picked === wanted, made.draw);
    const { start_value, end_value, steps, start } = made.ascent,
      words = await by(page, "ascent").textContent();
    assert.ok(words.includes(`in ${steps} step`), words);
    await by(page, "hold-start").click();
    const cells = (name) => by(page, "beside").locator(`tr[data-metric="${name}"] td`);
    const numbers = async (name) => (await cells(name).allTextContents()).map(Number.parseFloat);
    const near = (shown, value) => Math.abs(shown - value) <= 0.006 * Math.abs(value);
    const worth = await numbers("end_value");
    assert.ok(near(worth[0], start_value) && near(worth[1], end_value), worth.join());
    assert.equal(await cells("end_value").nth(1).getAttribute("class"), "better");
    assert.ok(near((await numbers("stroke_max"))[0], 100 * start.metrics.stroke_max));
    assert.ok(await by(page, "beside-histories").isVisible());
    await by(page, "release").click();
    return `${made.draw}: ${start_value} to ${end_value}`;
  });
}

export async function parallel_checks(page, data) {
  await brush_check(page, data);
  await front_check(page, data);
  await ascent_check(page, data);
}
