// A picked draw: crease pattern, folding, histories, springs.
import assert from "node:assert/strict";
import { axis, by, check, eventually, floats, pixels, state } from "./reading.mjs";

/** Letters on a drawing that are shown: how many, how high in px, and how many lie on others. */
const letters_of = (drawing) =>
  drawing.evaluate((svg) => {
    const texts = [...svg.querySelectorAll("text")].filter((t) => t.style.display !== "none"),
      frames = texts.map((text) => text.getBoundingClientRect());
    const px = texts.map(
      (text) => parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a,
    );
    let meeting = 0;
    // Letters' boxes are a little higher than what is drawn in them.
    frames.forEach((a, i) =>
      frames.slice(0, i).forEach((b) => {
        meeting +=
          a.left + 1 < b.right &&
          b.left + 1 < a.right &&
          a.top + 4 < b.bottom &&
          b.top + 4 < a.bottom;
      }),
    );
    return { count: texts.length, least: Math.min(...px), most: Math.max(...px), meeting };
  });

async function zoom_checks(page) {
  await check("the crease pattern zooms, and its letters can be read at every zoom", async () => {
    const drawing = by(page, "crease-drawing"),
      box = () => drawing.getAttribute("viewBox");
    const legible = async (when) => {
      const { count, least, most, meeting } = await letters_of(drawing);
      assert.ok(
        count > 0 && least > 10.4 && most < 18,
        `${when}: letters of ${least} to ${most} px`,
      );
      assert.equal(meeting, 0, `${when}: letters on each other`);
    };
    const whole = await box();
    await legible("whole");
    for (let i = 0; i < 4; ++i) await by(page, "zoom-in").click();
    const [, , width] = (await box()).split(" ").map(Number);
    assert.ok(width < 0.3 * Number(whole.split(" ")[2]), `four steps nearer: ${width}`);
    await legible("near");
    const near = await box();
    await drawing.evaluate((svg) => svg.scrollIntoView({ block: "center" }));
    const { x, y, width: w, height: h } = await drawing.boundingBox();
    await page.mouse.move(x + w / 2, y + h / 2);
    await page.mouse.down();
    await page.mouse.move(x + w / 2 - 50, y + h / 2 - 30, { steps: 3 });
    await page.mouse.up();
    assert.notEqual(await box(), near, "it does not move");
    const moved = await box();
    await page.mouse.wheel(0, -200); // it has the focus now
    await eventually(
      page,
      {
        test: (was) => document.querySelector("#crease svg.sheet").getAttribute("viewBox") !== was,
        with: moved,
      },
      "the wheel does not zoom",
    );
    await by(page, "zoom-fit").click();
    assert.equal(await box(), whole);
    await by(page, "zoom-fit").blur();
    const [sheet, card] = [
      await drawing.evaluate(
        (svg) => svg.querySelector(".panel").parentNode.getBoundingClientRect().width,
      ),
      await by(page, "crease-pattern").boundingBox(),
    ];
    assert.ok(sheet > 0.98 * card.width, "the drawing takes its card's width");
  });
}

/** What moves a drawing that is zoomed, and what does not. */
async function drag_checks(page) {
  const drawing = by(page, "crease-drawing"),
    box = () => drawing.getAttribute("viewBox");
  const drag = async (button) => {
    const { x, y, width, height } = await drawing.boundingBox(),
      [left, top] = [x + width / 2, y + height / 2];
    await page.mouse.move(left, top);
    await page.mouse.down({ button });
    await page.mouse.move(left - 50, top - 30, { steps: 3 });
    await page.mouse.up({ button });
  };
  await check("the crease pattern is moved by the first button alone, while it is down", async () => {
    for (let i = 0; i < 4; ++i) await by(page, "zoom-in").click();
    await drawing.evaluate((svg) => svg.scrollIntoView({ block: "center" }));
    const before = await box();
    await drag("right");
    assert.equal(await box(), before, "the right button moves it");
    await drawing.evaluate((svg) => {
      svg.setPointerCapture = () => {}; // of a pointer that is none
      const { x, y } = svg.getBoundingClientRect(),
        tell = (kind, at, buttons) =>
          svg.dispatchEvent(
            new PointerEvent(kind, { pointerId: 7, clientX: x + at, clientY: y + at, buttons }),
          );
      tell("pointerdown", 50, 1);
      tell("pointermove", 90, 0); // the button was let go outside
      tell("pointermove", 120, 0);
      delete svg.setPointerCapture;
    });
    assert.equal(await box(), before, "it follows a pointer that no button holds");
  });
  await check("its letters are placed anew for another scale, and not for another place", async () => {
    await drawing.evaluate((svg) => {
      svg.seen = 0;
      const watching = new MutationObserver((records) => (svg.seen += records.length));
      for (const text of svg.querySelectorAll("text"))
        watching.observe(text, { attributes: true });
    });
    const seen = () => drawing.evaluate((svg) => svg.seen),
      before = await box();
    await drag("left");
    assert.notEqual(await box(), before, "it does not move");
    assert.equal(await seen(), 0, "letters were placed while it was dragged");
    await by(page, "zoom-out").click();
    assert.ok((await seen()) > 0, "no letters were placed");
    await by(page, "zoom-fit").click();
    await by(page, "zoom-fit").blur();
  });
}

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
  const depth = detail.pilot_deg.findLastIndex(
    (pilot) => pilot <= detail.verdict.deploys_from_deg + 1e-9,
  );
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

export async function detail_checks(page, data, detail, webgl = true) {
  const canvas = by(page, "folding-canvas"),
    slider = by(page, "pilot");
  // As if nobody had said yet how the moment is to be drawn.
  await by(page, "moment-log").evaluate((node) => delete node.dataset.said);
  await by(page, "detailed").selectOption(detail.draw);
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
    assert.equal(
      await by(page, "command-actuators").textContent(),
      `${misalign} actuators ${catalogue} ${detail.draw}${springs}`,
    );
  });

  await check("the crease pattern has every crease, hole, diagonal and shift", async () => {
    const svg = by(page, "crease-pattern").locator("svg.sheet");
    const of = (kind) => data.sheet.creases.filter((crease) => crease.assignment === kind).length;
    const shifted = Object.entries(detail.displacements_mm).filter(([, [x, y]]) => x || y);
    assert.deepEqual(
      await Promise.all(
        [".mountain", ".valley", ".hole", ".diagonal", ".arrow"].map((name) =>
          svg.locator(name).count(),
        ),
      ),
      [
        of("mountain"),
        of("valley"),
        data.sheet.holes.length,
        data.diagonals.length,
        shifted.length,
      ],
    );
    assert.deepEqual(
      await svg.locator(".diagonal text").allTextContents(),
      data.diagonals.map((_, d) => String(d)),
      "numbers as in the catalogue's view, from 0",
    );
    assert.equal(await by(page, "diagonals").locator("tbody td").first().textContent(), "0");
    const labels = await svg.locator(".vertex-label").allTextContents();
    assert.deepEqual(labels.sort(), shifted.map(([name]) => name).sort());
    // An arrow points where the shift points: y is up on the sheet and down on the screen.
    for (const [i, [name, [dx, dy]]] of shifted.entries()) {
      const [x1, y1, x2, y2] = await svg
        .locator(".arrow")
        .nth(i)
        .evaluate((node) => ["x1", "y1", "x2", "y2"].map((a) => Number(node.getAttribute(a))));
      assert.ok(
        Math.abs(Math.atan2(y1 - y2, x2 - x1) - Math.atan2(dy, dx)) < 0.01,
        `arrow of ${name}`,
      );
      if (i > 3) break;
    }
  });

  await zoom_checks(page);
  await drag_checks(page);

  await check("the sheet is drawn in space", async () => {
    const { colours } = await pixels(canvas);
    assert.ok(colours > (webgl ? 20 : 4), `${colours} colours`);
    return `${colours} colours`;
  });

  const go = async (k) => {
    await slider.evaluate((node, value) => {
      node.value = value;
      node.dispatchEvent(new Event("input", { bubbles: true }));
    }, k);
    return state(page);
  };
  const rules = () =>
    page
      .locator('[data-testid="rule"]')
      .evaluateAll((nodes) => nodes.map((node) => Number(node.getAttribute("x1"))));
  await check("slider, sheet, histories and forces move together", async () => {
    const n = detail.pilot_deg.length,
      seen = new Set(),
      covered = [],
      lengths = floats(detail.length_mm),
      count = data.diagonals.length;
    const charts = ["histories", "energy", "moment", "advantage"],
      scales = [];
    for (const id of charts) scales.push(await axis(by(page, id), "x"));
    for (const k of [0, Math.floor(n / 3), Math.floor((2 * n) / 3), n - 1]) {
      const pilot = detail.pilot_deg[k];
      assert.equal((await go(k)).pilot_deg, pilot);
      assert.equal(await by(page, "pilot-deg").textContent(), `${pilot}°`);
      const now = await rules();
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
      const cell = (
        await by(page, "diagonals").locator("tbody tr").last().locator("td").nth(3).textContent()
      )
        .replace("−", "-")
        .replace(" %", "");
      assert.ok(
        Math.abs(Number(cell) - 100 * relative) < 0.0051,
        `elongation of the last diagonal: ${cell}`,
      );
      const newtons =
        data.actuators.stiffness_n_per_mm * (lengths[k * count + count - 1] - lengths[count - 1]);
      const said = (
        await by(page, "diagonals").locator("tbody tr").last().locator("td").nth(5).textContent()
      )
        .replace("−", "-")
        .replace(" N", "");
      assert.ok(Math.abs(Number(said) - newtons) < 0.06, `force of its spring: ${said} N`);
    }
    assert.equal(
      seen.size,
      Math.min(4, new Set([0, Math.floor(n / 3), Math.floor((2 * n) / 3), n - 1]).size),
      "the sheet's pictures",
    );
    if (detail.pilot_deg.at(-1) >= 60) {
      assert.ok(covered.at(-1) < 0.95 * covered[0], "folded, the sheet covers less");
    }
  });

  await check("histories run through the data", async () => {
    const x = await axis(by(page, "histories"), "x"),
      y = await axis(by(page, "histories"), "y"),
      lengths = floats(detail.length_mm),
      count = data.diagonals.length;
    const depth = detail.pilot_deg.findLastIndex(
      (pilot) => pilot <= detail.verdict.deploys_from_deg + 1e-9,
    );
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

  await check("D is marked on the slider", async () => {
    await go(
      detail.pilot_deg.findLastIndex((pilot) => pilot <= detail.verdict.deploys_from_deg + 1e-9),
    );
    const [mark, track] = [await by(page, "mark-depth").boundingBox(), await slider.boundingBox()];
    const share = 1 - Number(await slider.inputValue()) / (detail.pilot_deg.length - 1);
    assert.ok(
      Math.abs(mark.x - (track.x + 8 + share * (track.width - 16))) < 3,
      "the mark and the slider's place",
    );
  });

  await check("a diagonal in focus or under the pointer is marked in all views", async () => {
    await go(Math.floor(detail.pilot_deg.length / 2));
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

  await spring_checks(page, detail);

  await check("space plays and pauses, arrow keys move the slider", async () => {
    await go(detail.pilot_deg.length - 1);
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
    await go(3);
    await page.keyboard.press("ArrowLeft");
    assert.equal((await state(page)).pilot_deg, detail.pilot_deg[4], "left folds");
    await page.keyboard.press("ArrowRight");
    assert.equal((await state(page)).pilot_deg, detail.pilot_deg[3], "right unfolds");
  });

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
