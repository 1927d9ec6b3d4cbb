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

/** Whether the picked one of these is as near to a place as any, but for the pixel's edge. */
async function picks_nearest(page, place, points) {
  const { picked } = await state(page),
    point = points.find(({ draw }) => draw === picked),
    away = (q) => Math.hypot(q.x - place.x, q.y - place.y);
  return point !== undefined && away(point) < away(nearest(place, points)) + 2;
}

/** Where the axes say that the candidates are. */
async function points_of(page, { columns }) {
  await by(page, "scatter-x").selectOption(across);
  await by(page, "scatter-y").selectOption(up);
  const box = by(page, "scatter");
  await by(page, "scatter-canvas").scrollIntoViewIfNeeded();
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

export async function scatter_checks(page, data) {
  await frame_check(page);
  await click_check(page, data);
  await arrow_check(page, data);
  await title_check(page);
}
