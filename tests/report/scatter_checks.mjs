// Two metrics of the candidates against each other.
import assert from "node:assert/strict";
import { axis, by, median, state, unfiltered } from "./reading.mjs";

const across = "stroke_max",
  up = "elongation_max";

async function frame_check(page) {
  await unfiltered(page, "points and axes of the scatter lie on each other", async () => {
    const [points, axes] = [
      await by(page, "scatter-canvas").boundingBox(),
      await by(page, "scatter").locator("svg.plot").boundingBox(),
    ];
    for (const side of ["x", "y", "width", "height"])
      assert.ok(Math.abs(points[side] - axes[side]) < 1, `${side}: ${points[side]}, ${axes[side]}`);
  });
}

const nearest = (to, among) =>
  among.reduce((best, p) =>
    (p.x - to.x) ** 2 + (p.y - to.y) ** 2 < (best.x - to.x) ** 2 + (best.y - to.y) ** 2 ? p : best,
  );

/** The three that are farthest from any other. */
function lonely(points) {
  const xs = Float64Array.from(points, ({ x }) => x),
    ys = Float64Array.from(points, ({ y }) => y),
    away = new Float64Array(points.length).fill(Infinity);
  for (let i = 0; i < xs.length; ++i) {
    for (let k = 0; k < i; ++k) {
      const square = (xs[i] - xs[k]) ** 2 + (ys[i] - ys[k]) ** 2;
      if (square < away[i]) away[i] = square;
      if (square < away[k]) away[k] = square;
    }
  }
  return points
    .map((_, i) => i)
    .sort((i, k) => away[k] - away[i])
    .slice(0, 3)
    .map((i) => points[i]);
}

/** Returns whether the picked one of these is as near to a place as any, but for the pixel's edge. */
async function picks_nearest(page, place, points) {
  const { picked } = await state(page),
    point = points.find(({ draw }) => draw === picked),
    away = (q) => Math.hypot(q.x - place.x, q.y - place.y);
  return point !== undefined && away(point) < away(nearest(place, points)) + 2;
}

/** Places of the candidates in the whole plot of the two metrics. */
async function points_of(page, candidates) {
  await by(page, "scatter-x").selectOption(across);
  await by(page, "scatter-y").selectOption(up);
  await by(page, "scatter-canvas").scrollIntoViewIfNeeded();
  return points_of_axes(page, candidates);
}

/** Places of the candidates by the axes. */
async function points_of_axes(page, { columns }) {
  const box = by(page, "scatter");
  const [x, y] = [await axis(box, "x"), await axis(box, "y")];
  return columns.draw.map((draw, i) => ({
    draw,
    x: x(100 * columns[across][i]),
    y: y(100 * columns[up][i]),
    filtered: columns[up][i],
  }));
}

async function click_check(page, { candidates }) {
  const what = "a click on the scatter picks the nearest, of those that the filter leaves",
    canvas = by(page, "scatter-canvas");
  await unfiltered(page, what, async () => {
    const points = await points_of(page, candidates),
      far_off = lonely(points);
    for (const p of far_off) {
      const place = { x: p.x + 1, y: p.y + 1 };
      await canvas.click({ position: place });
      assert.ok(await picks_nearest(page, place, points), `a click beside ${p.draw}`);
    }
    const { width, height } = await canvas.boundingBox();
    for (const [right, down] of [
      [0.3, 0.3],
      [0.5, 0.6],
      [0.7, 0.2],
      [0.8, 0.8],
    ]) {
      const place = { x: right * width, y: down * height };
      await canvas.click({ position: place });
      assert.ok(await picks_nearest(page, place, points), `a click at ${place.x}, ${place.y}`);
    }
    const [p] = far_off,
      limit = median(candidates.columns[up]),
      [sign, leaves] =
        p.filtered < limit ? [">=", (q) => q.filtered >= limit] : ["<", (q) => q.filtered < limit];
    const kept = points.filter(leaves);
    await by(page, "filter").fill(`${up} ${sign} ${limit}`);
    await canvas.click({ position: { x: p.x, y: p.y } });
    if (kept.length)
      assert.ok(await picks_nearest(page, p, kept), "the filter does not hold in the scatter");
    await by(page, "filter").fill("");
  });
}

async function arrow_check(page, { candidates: { columns } }) {
  await unfiltered(page, "arrow keys go through the scatter", async () => {
    await by(page, "scatter-canvas").focus();
    const least = columns[across].indexOf(Math.min(...columns[across]));
    await by(page, "filter").fill(`draw = ${columns.draw[least]}`);
    await by(page, "scatter-canvas").click({ position: { x: 100, y: 100 } });
    assert.equal((await state(page)).picked, columns.draw[least]);
    await by(page, "filter").fill("");
    await by(page, "scatter-canvas").focus();
    await page.keyboard.press("ArrowRight");
    const next = (await state(page)).picked,
      value = columns[across][columns.draw.indexOf(next)];
    assert.notEqual(next, columns.draw[least]);
    assert.equal(
      columns[across].filter((v) => v < value && v > columns[across][least]).length,
      0,
      "not the next one to the right",
    );
  });
}

async function title_check(page) {
  await unfiltered(page, "no title of the scatter lies on its ticks", async () => {
    const names = await by(page, "scatter-y")
      .locator("option")
      .evaluateAll((nodes) => nodes.map((node) => node.value));
    const before = await by(page, "scatter-y").inputValue();
    for (const name of names) {
      await by(page, "scatter-y").selectOption(name);
      const gap = await by(page, "scatter").evaluate((box) => {
        const right = (node) => node.getBoundingClientRect().right,
          left = (node) => node.getBoundingClientRect().left;
        const ticks = [...box.querySelectorAll('g[aria-label^="y-axis tick label"] text')];
        return (
          Math.min(...ticks.map(left)) -
          right(box.querySelector('g[aria-label="y-axis label"] text'))
        );
      });
      assert.ok(gap > 1, `${name}: ${gap.toFixed(1)} px`);
    }
    await by(page, "scatter-y").selectOption(before);
    return `${names.length} metrics`;
  });
}

const drawn = (page, id) => by(page, id).getAttribute("data-drawn");
const note = (page) => page.locator("#scatter-note").textContent();

/** Drags over the scatter from one place to another. */
async function drag(page, from, to) {
  const { x, y } = await by(page, "scatter-canvas").boundingBox();
  await page.mouse.move(x + from.x, y + from.y);
  await page.mouse.down();
  await page.mouse.move(x + (from.x + to.x) / 2, y + (from.y + to.y) / 2);
  await page.mouse.move(x + to.x, y + to.y);
  await page.mouse.up();
}

/** A region of few points around the middle one of those given, with room around its edges. */
function region_of(points, { width, height }) {
  const [x, y] = [median(points.map((p) => p.x)), median(points.map((p) => p.y))],
    sides = {
      left: x - width / 16,
      right: x + width / 16,
      top: y - height / 16,
      bottom: y + height / 16,
    };
  const count = (spare) =>
    points.filter(
      (p) =>
        p.x > sides.left - spare &&
        p.x < sides.right + spare &&
        p.y > sides.top - spare &&
        p.y < sides.bottom + spare,
    ).length;
  return { ...sides, least: count(-1), most: count(1) }; // a pixel more or less
}

async function region_check(page, { candidates }) {
  await unfiltered(page, "a drag enlarges a region, and a filter keeps it", async () => {
    const points = await points_of(page, candidates),
      canvas = by(page, "scatter-canvas"),
      { picked } = await state(page),
      { left, right, top, bottom, least, most } = region_of(points, await canvas.boundingBox());
    assert.ok(!(await by(page, "scatter-whole").isVisible()));
    await drag(page, { x: left, y: top }, { x: right, y: bottom });
    const said = await note(page),
      shown = Number(/^([\d,]+) candidate/.exec(said)[1].replaceAll(",", ""));
    assert.ok(shown >= least && shown <= most, `${least} to ${most}: ${said}`);
    assert.equal((await state(page)).picked, picked, "a drag is no click");
    // A click picks the nearest of those in the region, where they are now.
    const enlarged = (await points_of_axes(page, candidates)).filter(
      (p) => p.x > 70 && p.y > 15 && p.x < (right - left) * 8 && p.y < 350,
    );
    if (enlarged.length > 1) {
      const p = enlarged[Math.floor(enlarged.length / 2)];
      await canvas.click({ position: { x: p.x, y: p.y } });
      assert.ok(await picks_nearest(page, p, enlarged), "a click in the region");
    }
    await by(page, "scatter-keep").click();
    const typed = await by(page, "filter").inputValue(),
      [, a, b, c, d] =
        new RegExp(
          `^${across} >= (\\S+) ${across} <= (\\S+) ${up} >= (\\S+) ${up} <= (\\S+)$`,
        ).exec(typed) ?? assert.fail(typed);
    const { columns } = candidates,
      held = columns.draw.filter(
        (_, i) =>
          columns[across][i] >= a &&
          columns[across][i] <= b &&
          columns[up][i] >= c &&
          columns[up][i] <= d,
      ).length;
    assert.equal((await state(page)).filtered, held, typed);
    assert.ok(
      Math.abs(held - shown) <= 2 + most - least,
      `${held} filtered, ${shown} in the region`,
    );
    await by(page, "scatter-whole").click();
    assert.doesNotMatch(await note(page), /outside/);
    await by(page, "filter").fill("");
    // Keys enlarge the region around the picked candidate.
    await canvas.focus();
    await page.keyboard.press("+");
    assert.ok(await by(page, "scatter-whole").isVisible());
    await page.keyboard.press("-");
    await page.keyboard.press("-");
    assert.ok(!(await by(page, "scatter-whole").isVisible()), "the whole plot by keys");
    return `${shown} of ${points.length}`;
  });
}

const kMany = 2000; // candidates; more are hexagons

async function hexagon_check(page, { candidates: { columns } }) {
  await unfiltered(page, "many candidates are hexagons with counts, few are points", async () => {
    const legend = by(page, "scatter-legend").locator("li"),
      with_value = columns[across].filter((v, i) => v !== null && columns[up][i] !== null).length;
    assert.equal(await drawn(page, "scatter-canvas"), with_value > kMany ? "hexagons" : "points");
    if (with_value <= kMany) {
      assert.equal(await legend.count(), 0);
      return `${with_value} points`;
    }
    const counts = (await legend.allTextContents()).map((text) => Number(text.replaceAll(",", "")));
    assert.equal(counts[0], 1);
    counts.slice(1).forEach((count, k) => assert.ok(count > counts[k], counts.join()));
    const colours = await legend
      .locator("i")
      .evaluateAll((nodes) => nodes.map((node) => getComputedStyle(node).backgroundColor));
    assert.equal(new Set(colours).size, counts.length);
    // The colour of the largest count is somewhere on the canvas, and so is that of one.
    for (const wanted of [colours[0], colours.at(-1)])
      assert.ok(await has_colour(page, wanted), `no hexagon is ${wanted}`);
    await by(page, "filter").fill(`${up} > ${Math.max(...columns[up]) * 0.9}`);
    assert.equal(await drawn(page, "scatter-canvas"), "points");
    assert.equal(await legend.count(), 0);
    await by(page, "filter").fill("");
    return `${with_value}: ${counts.join(", ")}`;
  });
}

const has_colour = (page, wanted) =>
  by(page, "scatter-canvas").evaluate((canvas, text) => {
    const copy = new OffscreenCanvas(canvas.width, canvas.height),
      pen = copy.getContext("2d", { willReadFrequently: true });
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height),
      rgb = text.match(/\d+/g).map(Number);
    for (let i = 0; i < data.length; i += 4)
      if (data[i + 3] === 255 && rgb.every((byte, k) => data[i + k] === byte)) return true;
    return false;
  }, wanted);

export async function scatter_checks(page, data) {
  await frame_check(page);
  await click_check(page, data);
  await arrow_check(page, data);
  await region_check(page, data);
  await hexagon_check(page, data);
  await title_check(page);
}
