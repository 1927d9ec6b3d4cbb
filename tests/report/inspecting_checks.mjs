// A picked draw: folding, histories, springs.
/* global misalign -- of the page */
import assert from "node:assert/strict";
import { crease_check, drag_checks, width_check, zoom_checks } from "./crease_checks.mjs";
import { axis, by, check, depth_of, eventually, floats, pixels, state } from "./reading.mjs";

/** Keys of the browser are left to it: Alt with an arrow goes back. */
export async function key_checks(page) {
  const taken = (id, key, held = {}) =>
    by(page, id).evaluate(
      (node, options) =>
        !node.dispatchEvent(
          new KeyboardEvent("keydown", { bubbles: true, cancelable: true, ...options }),
        ),
      { key, ...held },
    );
  await check("arrow keys move the views, and with a key of the browser go to it", async () => {
    for (const id of ["crease-drawing", "folding-canvas", "scatter-canvas", "grid"]) {
      const key = id === "grid" ? "Home" : "ArrowLeft";
      assert.ok(await taken(id, key), `${id}: ${key}`);
      for (const held of ["altKey", "ctrlKey", "metaKey"])
        assert.ok(!(await taken(id, key, { [held]: true })), `${id}: ${key} with ${held}`);
    }
    assert.ok(!(await taken("scatter-canvas", "ArrowLeft", { shiftKey: true })), "shiftKey");
    for (const id of ["crease-drawing", "folding-canvas", "scatter-canvas"])
      assert.equal(await by(page, id).getAttribute("role"), "application", id);
  });
}

async function spring_checks(page, detail) {
  const depth = depth_of(detail);
  const moments = floats(detail.moment_n_mm);
  await check("the moment's axis begins where there is something to see", async () => {
    const looked_at = moments.slice(0, depth + 1).filter((_, k) => detail.pilot_deg[k] >= 5);
    const [least, most] = [Math.min(...looked_at), Math.max(...looked_at)];
    const wanted = least > 0 && most > 300 * least;
    if (wanted) assert.ok(await by(page, "moment-log").isChecked(), "weak and strong on one scale");
    if (!(least > 0))
      assert.ok(!(await by(page, "moment-log").isChecked()), "no logarithm of this");
    const frame = (await by(page, "moment").locator("svg.plot").boundingBox()).height;
    if (wanted) {
      const y = await axis(by(page, "moment"), "y", Math.log10);
      const away = frame - 40 - y(least);
      assert.ok(away > 5 && away < 0.3 * frame, `the weakest point is ${away.toFixed(0)} px up`);
    }
    await by(page, "moment-log").uncheck();
    const y = await axis(by(page, "moment"), "y");
    const below = frame - 40 - y(0);
    if (Math.min(...moments.slice(0, depth + 1)) > -1e-6 * most && depth === moments.length - 1)
      assert.ok(Math.abs(below) < 1.5, `${below.toFixed(1)} px below zero hold nothing`);
    await by(page, "moment-log").check();
  });

  await check("energy and moment on a logarithmic scale", async () => {
    const line = () =>
      Promise.all(
        ["energy", "moment", "advantage"].map((id) =>
          by(page, id).locator("path.value").first().getAttribute("d"),
        ),
      );
    for (const id of ["energy", "moment"]) await by(page, `${id}-log`).uncheck();
    const before = await line();
    for (const id of ["energy", "moment"]) await by(page, `${id}-log`).check();
    const after = await line();
    if (detail.weakest?.moment_n_mm > 0) assert.notEqual(after[1], before[1], "moment");
    assert.notEqual(after[0], before[0], "energy");
    assert.equal(after[2], before[2], "mechanical advantage");
    for (const id of ["energy", "moment"]) await by(page, `${id}-log`).uncheck();
    assert.deepEqual(await line(), before);
  });

  await check("forces run through the data", async () => {
    for (const [id, values] of [
      ["energy", floats(detail.energy_n_mm)],
      ["moment", moments],
    ]) {
      const y = await axis(by(page, id), "y");
      const path = await by(page, id).locator("path.value").first().getAttribute("d"),
        [, py] = path.split(/[ML]/).at(-1).split(",").map(Number);
      assert.ok(Math.abs(py - y(values[depth])) < 1, `${id} at D`);
    }
  });
}

/** Moves the slider. */
async function go(page, k) {
  await by(page, "pilot").evaluate((node, value) => {
    node.value = value;
    node.dispatchEvent(new Event("input", { bubbles: true }));
  }, k);
  return state(page);
}

const rules = (page) =>
  page
    .locator('[data-testid="rule"]')
    .evaluateAll((nodes) => nodes.map((node) => Number(node.getAttribute("x1"))));

/** A cell of the last diagonal's row as a number. */
async function last_diagonal(page, column) {
  const row = by(page, "diagonals").locator("tbody tr").last();
  const text = await row.locator("td").nth(column).textContent();
  return Number(text.replace("−", "-").replace(/ (%|N)$/, ""));
}

async function words_check(page, data, detail) {
  await check(`draw ${detail.draw}: title, verdict and metrics`, async () => {
    assert.equal((await state(page)).picked, detail.draw);
    assert.match(await by(page, "picked").textContent(), new RegExp(detail.draw));
    assert.match(
      await by(page, "picked-words").textContent(),
      detail.accepted ? /^Accepted/ : /^Not accepted/,
    );
    if (detail.verdict.deploys_from_deg > 0)
      assert.ok(
        (await by(page, "picked-words").textContent()).includes(
          `${detail.verdict.deploys_from_deg}°`,
        ),
      );
    if (detail.metrics)
      assert.ok(
        (await by(page, "metrics").textContent()).includes(
          `${(100 * detail.metrics.stroke_max).toFixed(2)} %`,
        ),
        "stroke_max",
      );
    assert.ok(await by(page, "folding").isVisible());
    const { misalign, catalogue, springs } = data.commands;
    for (const [id, words] of [
      ["card", `card ${catalogue} ${detail.draw}${springs} --output card-${detail.draw}.html`],
      ["actuators", `actuators ${catalogue} ${detail.draw}${springs}`],
    ])
      assert.equal(await by(page, `command-${id}`).textContent(), `${misalign} ${words}`);
  });
}

async function picture_check(page, webgl) {
  await check("the sheet is drawn in space", async () => {
    const { colours } = await pixels(by(page, "folding-canvas"));
    assert.ok(colours > (webgl ? 20 : 4), `${colours} colours`);
    return `${colours} colours`;
  });
}

async function together_check(page, data, detail) {
  const canvas = by(page, "folding-canvas");
  await check("slider, sheet, histories and forces move together", async () => {
    const n = detail.pilot_deg.length,
      places = [0, Math.floor(n / 3), Math.floor((2 * n) / 3), n - 1],
      seen = new Set(),
      covered = [],
      lengths = floats(detail.length_mm),
      count = data.diagonals.length;
    const charts = ["energy", "moment", "histories", "advantage"],
      scales = [];
    for (const id of charts) scales.push(await axis(by(page, id), "x"));
    for (const k of places) {
      const pilot = detail.pilot_deg[k];
      assert.equal((await go(page, k)).pilot_deg, pilot);
      assert.equal(await by(page, "pilot-deg").textContent(), `${pilot}°`);
      const now = await rules(page);
      assert.equal(now.length, charts.length, "charts with a rule");
      charts.forEach((id, i) =>
        assert.ok(
          Math.abs(now[i] - scales[i]((180 - pilot) / 180)) < 1,
          `the rule of ${id} at ${pilot}°`,
        ),
      );
      const picture = await pixels(canvas);
      seen.add(picture.hash);
      covered.push(picture.covered);
      const relative = lengths[k * count + count - 1] / lengths[count - 1] - 1;
      const elongation = await last_diagonal(page, 3);
      assert.ok(Math.abs(elongation - 100 * relative) < 0.0051, `elongation: ${elongation} %`);
      const newtons =
        data.actuators.stiffness_n_per_mm * (lengths[k * count + count - 1] - lengths[count - 1]);
      const force = await last_diagonal(page, 5);
      assert.ok(Math.abs(force - newtons) < 0.06, `force of its spring: ${force} N`);
    }
    assert.equal(seen.size, new Set(places).size, "the sheet's pictures");
    if (detail.pilot_deg.at(-1) >= 60) {
      assert.ok(covered.at(-1) < 0.95 * covered[0], "folded, the sheet covers less");
    }
  });
}

/** Let go, the sheet on the page ends where its data do. */
async function let_go_check(page, detail) {
  const { let_go } = detail;
  await check("the sheet is let go in real time", async () => {
    if (!let_go) return assert.ok(!(await by(page, "let-go").isVisible()), "a chart of nothing");
    const pilot_deg = floats(let_go.pilot_deg),
      time_s = floats(let_go.time_s);
    const x = await axis(by(page, "let-go"), "x"),
      y = await axis(by(page, "let-go"), "y");
    const path = await by(page, "let-go")
      .locator('g[aria-label="line"] path')
      .first()
      .getAttribute("d");
    const [px, py] = path.split(/[MLC]/).at(-1).split(",").slice(-2).map(Number);
    assert.ok(
      Math.abs(px - x(time_s.at(-1))) < 1 && Math.abs(py - y(pilot_deg.at(-1))) < 1,
      "the end of the line",
    );
    await go(page, Math.min(3, detail.pilot_deg.length - 1));
    await by(page, "let-go-play").click();
    const end_deg = Math.abs(pilot_deg.at(-1));
    const nearest = detail.pilot_deg.reduce((a, b) =>
      Math.abs(b - end_deg) < Math.abs(a - end_deg) ? b : a,
    );
    await eventually(
      page,
      {
        test: (angle) =>
          misalign.pilot_deg === angle &&
          document.getElementById("let-go-play").textContent.startsWith("▶"),
        with: nearest,
      },
      `it is not at ${nearest}° in the end`,
    );
  });
}

async function history_check(page, data, detail) {
  await check("histories run through the data", async () => {
    const x = await axis(by(page, "histories"), "x"),
      y = await axis(by(page, "histories"), "y"),
      lengths = floats(detail.length_mm),
      count = data.diagonals.length;
    const depth = depth_of(detail);
    for (const d of [0, count - 1]) {
      const path = await by(page, "histories")
        .locator(`.history[data-diagonal="${d}"] path`)
        .first()
        .getAttribute("d");
      const [px, py] = path.split(/[ML]/).at(-1).split(",").map(Number);
      assert.ok(
        Math.abs(px - x((180 - detail.pilot_deg[depth]) / 180)) < 1 &&
          Math.abs(py - y(lengths[depth * count + d] / lengths[d])) < 1,
        `diagonal ${d + 1} at D`,
      );
      const grows = lengths[depth * count + d] >= lengths[d];
      if (depth > 0)
        assert.equal(
          await by(page, "histories")
            .locator(`.history[data-diagonal="${d}"]`)
            .evaluate((node) => node.classList.contains("grows")),
          grows,
        );
    }
  });
}

async function depth_check(page, detail) {
  const slider = by(page, "pilot");
  await check("D is marked on the slider", async () => {
    await go(page, depth_of(detail));
    const [mark, track] = [await by(page, "mark-depth").boundingBox(), await slider.boundingBox()];
    const share = 1 - Number(await slider.inputValue()) / (detail.pilot_deg.length - 1);
    assert.ok(
      Math.abs(mark.x - (track.x + 8 + share * (track.width - 16))) < 3,
      "the mark and the slider's place",
    );
  });
}

async function marking_check(page, detail) {
  const canvas = by(page, "folding-canvas");
  const slider = by(page, "pilot");
  await check("a diagonal in focus or under the pointer is marked in all views", async () => {
    await go(page, Math.floor(detail.pilot_deg.length / 2));
    await page.mouse.move(2, 2); // what scrolls below the pointer would be marked
    const picked = () =>
      Promise.all(
        ["crease-pattern", "histories", "diagonals"].map((id) =>
          by(page, id)
            .locator(".picked")
            .evaluateAll((nodes) => nodes.map((node) => Number(node.dataset.diagonal))),
        ),
      );
    const before = (await pixels(canvas)).hash;
    await by(page, "diagonals").locator("button").nth(1).focus();
    assert.deepEqual(await picked(), [[1], [1], [1]]);
    assert.notEqual((await pixels(canvas)).hash, before, "not marked on the sheet");
    await slider.focus();
    assert.deepEqual(await picked(), [[], [], []]);
    assert.equal((await pixels(canvas)).hash, before);
    await by(page, "crease-pattern").locator('.diagonal[data-diagonal="0"] text').hover();
    assert.deepEqual(await picked(), [[0], [0], [0]]);
    await page.mouse.move(2, 2);
  });
}

async function playing_check(page, detail) {
  const slider = by(page, "pilot");
  await check("space plays and pauses, arrow keys move the slider", async () => {
    await go(page, detail.pilot_deg.length - 1);
    await slider.focus();
    await page.keyboard.press("Space");
    await eventually(
      page,
      { test: (from) => misalign.pilot_deg !== from, with: detail.pilot_deg.at(-1) },
      "it does not play",
    );
    await page.keyboard.press("Space");
    const { pilot_deg } = await state(page);
    await page.waitForTimeout(250);
    assert.equal((await state(page)).pilot_deg, pilot_deg, "it does not pause");
    await go(page, 3);
    await page.keyboard.press("ArrowLeft");
    assert.equal((await state(page)).pilot_deg, detail.pilot_deg[4], "left folds");
    await page.keyboard.press("ArrowRight");
    assert.equal((await state(page)).pilot_deg, detail.pilot_deg[3], "right unfolds");
  });
}

async function turning_check(page) {
  const canvas = by(page, "folding-canvas");
  await check("mouse and keyboard turn the sheet", async () => {
    const seen = [(await pixels(canvas)).hash];
    await canvas.focus();
    for (const key of ["ArrowLeft", "ArrowUp", "+"]) {
      await page.keyboard.press(key);
      seen.push((await pixels(canvas)).hash);
    }
    const { x, y, width, height } = await canvas.boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2 + 60, y + height / 2 + 20, { steps: 3 });
    await page.mouse.up();
    await page.mouse.move(2, 2);
    seen.push((await pixels(canvas)).hash);
    assert.equal(new Set(seen).size, 5);
    await page.keyboard.press("0");
  });
}

export async function detail_checks(page, data, detail, webgl = true) {
  // Nobody has said yet how the moment is to be drawn.
  await by(page, "moment-log").evaluate((node) => delete node.dataset.said);
  await by(page, "detailed").selectOption(detail.draw);
  await words_check(page, data, detail);
  await crease_check(page, data, detail);
  await width_check(page);
  await zoom_checks(page);
  await drag_checks(page);
  await picture_check(page, webgl);
  await together_check(page, data, detail);
  await history_check(page, data, detail);
  await depth_check(page, detail);
  await marking_check(page, detail);
  await spring_checks(page, detail);
  await let_go_check(page, detail);
  await playing_check(page, detail);
  await turning_check(page);
}
