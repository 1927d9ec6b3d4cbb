// The crease pattern of a picked draw.
import assert from "node:assert/strict";
import { by, check, eventually } from "./reading.mjs";

/** The drawing has every part of the sheet, and each shift where it points. */
export async function crease_check(page, data, detail) {
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
}

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

export async function zoom_checks(page) {
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
  });
}

/** Widths in px: of the panels together, the drawing, its card; and how much of it they fill. */
const widths_of = (page) =>
  by(page, "crease-drawing").evaluate((svg) => {
    const panels = [...svg.querySelectorAll(".panel")].map((node) => node.getBoundingClientRect()),
      taken = (least, most) =>
        Math.max(...panels.map((frame) => frame[most])) -
        Math.min(...panels.map((frame) => frame[least]));
    const [width, height] = [taken("left", "right"), taken("top", "bottom")],
      frame = svg.getBoundingClientRect();
    return {
      panels: width,
      drawing: frame.width,
      card: svg.parentNode.getBoundingClientRect().width,
      share: Math.max(width / frame.width, height / frame.height),
    };
  });

export async function width_check(page) {
  await check("the sheet fills its card, over half of the width or the whole of it", async () => {
    const button = by(page, "crease-wide"),
      was = await button.getAttribute("aria-pressed"),
      widths = {};
    for (const wide of [was, was === "true" ? "false" : "true"]) {
      if (wide !== was) await button.click();
      assert.equal(await button.getAttribute("aria-pressed"), wide);
      await eventually(
        page,
        {
          test: (whole) => {
            const card = document.querySelector("#crease").getBoundingClientRect().width;
            return card > 0.9 * document.getElementById("views").clientWidth === whole;
          },
          with: wide === "true",
        },
        `the card's width, ${wide}`,
      );
      const now = (widths[wide] = await widths_of(page));
      // The margin is a third of a panel.
      assert.ok(now.share > 0.83 && now.share < 1, `the panels take ${now.share} of the drawing`);
      assert.ok(Math.abs(now.drawing - now.card) < 1, `${now.drawing} px in ${now.card} px`);
    }
    assert.ok(widths.true.card > 1.9 * widths.false.card, "the whole width is twice the half");
    assert.ok(widths.true.panels > 1.3 * widths.false.panels, "the sheet grows with its card");
    await button.click();
    const { panels } = await widths_of(page);
    assert.ok(Math.abs(panels - widths[was].panels) < 1, "and is what it was");
  });
}

/** The acts that move a zoomed drawing, and those that do not. */
export async function drag_checks(page) {
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
  await check(
    "the crease pattern is moved by the first button alone, while it is down",
    async () => {
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
    },
  );
  await check(
    "its letters are placed anew for another scale, and not for another place",
    async () => {
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
    },
  );
}
