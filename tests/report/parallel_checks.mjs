// Parallel coordinates and the front, against the data of the page.
import assert from "node:assert/strict";
import { by, eventually, pixels, state, unfiltered } from "./reading.mjs";

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
    // There is no bound to the end of the axis; another axis has its own; a click takes one away.
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

const kFew = 300; // candidates; more are shown by their density

/** Strength of the colours along a column of the canvas: their distance from the card's. */
const strengths = (page, x) =>
  by(page, "parallel-canvas").evaluate((canvas, place) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height),
      pen = copy.getContext("2d", { willReadFrequently: true });
    pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--card");
    pen.fillRect(0, 0, 1, 1);
    const card = pen.getImageData(0, 0, 1, 1).data;
    pen.fillRect(0, 0, copy.width, copy.height);
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(Math.round(place), 0, 1, copy.height);
    return Array.from({ length: copy.height }, (_, y) =>
      Math.hypot(...[0, 1, 2].map((k) => data[4 * y + k] - card[k])),
    );
  }, x);

/** The height of each line halfway between two axes. */
function heights(columns, [from, to]) {
  const places = [from, to].map((name) => {
    const all = known(columns, name),
      [least, most] = [Math.min(...all), Math.max(...all)],
      of = least > 0 && most / least > 1000 ? Math.log : (value) => value;
    return columns[name].map((value) =>
      value === null
        ? NaN
        : kBottom - ((of(value) - of(least)) / (of(most) - of(least))) * (kBottom - kTop),
    );
  });
  return places[0].map((y, row) => (y + places[1][row]) / 2);
}

/** The number of lines within some px of each height, halfway between two axes. */
function crossings(columns, pair, reach = 2) {
  const counts = new Array(kBottom + 24).fill(0);
  for (const y of heights(columns, pair))
    for (let k = Math.floor(y - reach); k <= y + reach; ++k) ++counts[k]; // none for NaN
  return counts;
}

/** The card is seen where no line passes; the colour is strongest where most do. */
async function density_check(page, { candidates: { columns, shown } }) {
  if (!(await by(page, "parallel").isVisible())) return;
  await unfiltered(page, "many lines are a density, few are lines", async () => {
    const canvas = by(page, "parallel-canvas"),
      drawn = () => canvas.getAttribute("data-drawn");
    assert.equal(await drawn(), shown > kFew ? "density" : "lines");
    if (shown <= kFew) return `${shown} lines`;
    const axes = (await canvas.getAttribute("data-axes")).split(" "),
      { width } = await canvas.boundingBox(),
      step = (width - 2 * kSide) / (axes.length - 1);
    // The picked candidate's line lies above the others: it is left aside.
    const picked = columns.draw.indexOf((await state(page)).picked);
    let compared = 0;
    for (let k = 0; k + 1 < axes.length; ++k) {
      const pair = axes.slice(k, k + 2),
        counts = crossings(columns, pair),
        nearby = crossings(columns, pair, 6), // a place is a cell of 2 px, and smoothed
        strong = await strengths(page, kSide + (k + 0.5) * step),
        own = heights(columns, pair)[picked];
      const places = counts.map((_, y) => y).filter((y) => y >= kTop && y <= kBottom);
      const free = places.filter((y) => Math.abs(y - own) > 5 || Number.isNaN(own));
      for (const y of free) if (nearby[y] === 0) assert.ok(strong[y] < 3, `${pair}: ink at ${y}`);
      const by_count = free.filter((y) => counts[y] > 0).sort((a, b) => counts[a] - counts[b]),
        mean = (list) => list.reduce((sum, y) => sum + strong[y], 0) / list.length,
        part = Math.floor(by_count.length / 5);
      if (part < 2 || counts[by_count.at(-1)] < 5 * counts[by_count[0]]) continue;
      const [few, many] = [mean(by_count.slice(0, part)), mean(by_count.slice(-part))];
      assert.ok(
        many > 1.2 * few,
        `${pair}: ${few.toFixed(0)} where few, ${many.toFixed(0)} where many`,
      );
      ++compared;
    }
    assert.ok(compared > 0, "nothing was compared");
    const draws = columns.draw.map(BigInt).sort((a, b) => (a < b ? -1 : 1));
    await by(page, "filter").fill(`draw <= ${draws[Math.floor(kFew / 2)]}`);
    assert.equal(await drawn(), "lines");
    await by(page, "filter").fill("");
    assert.equal(await drawn(), "density");
    return `${compared} of ${axes.length - 1} gaps`;
  });
}

/** The hovered candidate of the scatter and of the table is a line of its own, while it is hovered. */
async function hover_check(page) {
  if (!(await by(page, "parallel").isVisible())) return;
  await unfiltered(
    page,
    "the hovered candidate is a line of the parallel coordinates",
    async () => {
      const canvas = by(page, "parallel-canvas");
      await page.mouse.move(2, 2);
      const before = await pixels(canvas);
      await by(page, "grid").locator(".line").nth(1).hover();
      const hovered = await pixels(canvas);
      assert.notEqual(hovered.hash, before.hash);
      await page.mouse.move(2, 2);
      assert.equal((await pixels(canvas)).hash, before.hash);
    },
  );
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

/** A search that made draws better says what each was worth, and shows it beside what it became. */
async function ascent_check(page, { details, candidates: { columns } }) {
  // Starts of populations are not stored, so that none can be held.
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
    await by(page, "hold-choice").selectOption("start");
    const cells = (name) => by(page, "beside").locator(`tr[data-metric="${name}"] td`);
    const numbers = async (name) => (await cells(name).allTextContents()).map(Number.parseFloat);
    const near = (shown, value) => Math.abs(shown - value) <= 0.006 * Math.abs(value);
    const worth = await numbers("end_value");
    assert.ok(near(worth[0], end_value) && near(worth[1], start_value), worth.join());
    assert.equal(await cells("end_value").nth(0).getAttribute("class"), "better");
    assert.ok(near((await numbers("stroke_max"))[1], 100 * start.metrics.stroke_max));
    assert.ok(await by(page, "beside-histories").isVisible());
    await by(page, "release").click();
    return `${made.draw}: ${start_value} to ${end_value}`;
  });
}

export async function parallel_checks(page, data) {
  await brush_check(page, data);
  await density_check(page, data);
  await hover_check(page);
  await front_check(page, data);
  await ascent_check(page, data);
}
