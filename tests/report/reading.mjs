// Parts of the checks of a page: the data inside it, read without the page's code, and what
// can be seen on it.
/* global misalign -- of the page */
import assert from "node:assert/strict";
import { AsyncLocalStorage } from "node:async_hooks";
import { readFileSync } from "node:fs";

let failures = 0,
  checks = 0;
const told = new AsyncLocalStorage();
export const say = (line) => (told.getStore() ?? { push: console.log }).push(line);

/** Runs at the same time, each of which says what it has to say in one piece. */
export const together = (runs) =>
  Promise.all(
    runs.map((run) =>
      told.run([], async () => {
        await run();
        console.log(told.getStore().join("\n"));
      }),
    ),
  );

/** Says how many checks passed; whether all did. */
export function summary() {
  console.log(`\n${checks - failures} of ${checks} checks passed`);
  return failures === 0;
}

/** Failures are said; passes only with VERBOSE=1, or a failure is lost in a long log. */
export async function check(what, run) {
  ++checks;
  const start = performance.now();
  try {
    const said = await run(),
      took_s = (performance.now() - start) / 1000;
    if (process.env.VERBOSE)
      say(
        `ok    ${what}${said ? `: ${said}` : ""}${took_s > 1 ? ` (${took_s.toFixed(1)} s)` : ""}`,
      );
  } catch (error) {
    ++failures;
    say(`FAIL  ${what}\n      ${String(error.message).split("\n").slice(0, 6).join("\n      ")}`);
  }
}

export function data_of(report) {
  const text = readFileSync(report, "utf8"),
    open = '<script type="application/json" id="report-data">';
  const start = text.indexOf(open) + open.length;
  return JSON.parse(text.slice(start, text.indexOf("</script>", start)));
}

export const floats = (base64) => {
  const bytes = Buffer.from(base64, "base64");
  return Array.from({ length: bytes.length / 4 }, (_, i) => bytes.readFloatLE(4 * i));
};
export const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
/** The last sample of the range that it deploys from. */
export const depth_of = ({ pilot_deg, verdict }) =>
  pilot_deg.findLastIndex((pilot) => pilot <= verdict.deploys_from_deg + 1e-9);
export const by = (page, id) => page.getByTestId(id);
export const state = (page) =>
  page.evaluate(() => ({
    picked: misalign.picked,
    pilot_deg: misalign.pilot_deg,
    filtered: misalign.filtered,
  }));
export const eventually = async (page, wanted, what) => {
  try {
    await page.waitForFunction(wanted.test, wanted.with);
  } catch {
    assert.fail(what);
  }
};

export const kManyColours = 64; // more are not counted

/** Scrolls an element into the window, and waits until the page knows: it draws what is seen. */
const in_view = async (locator) => {
  await locator.scrollIntoViewIfNeeded();
  await locator.evaluate(
    (node) =>
      new Promise((done) => {
        new IntersectionObserver(([{ isIntersecting }], watch) => {
          if (!isIntersecting) return;
          watch.disconnect();
          requestAnimationFrame(() => requestAnimationFrame(done));
        }).observe(node);
      }),
  );
};

/** Pixels of a canvas: a hash, how many are covered, and by how many colours, if they are few. */
export const pixels = async (locator) => {
  if ((await locator.getAttribute("data-testid")).endsWith("folding-canvas"))
    await in_view(locator);
  return locator.evaluate((canvas, most) => {
    const copy = Object.assign(document.createElement("canvas"), {
      width: canvas.width,
      height: canvas.height,
    });
    const pen = copy.getContext("2d", { willReadFrequently: true });
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height),
      colours = new Set();
    let hash = 0,
      covered = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = data[i] | (data[i + 1] << 8) | (data[i + 2] << 16) | (data[i + 3] << 24);
      hash = (Math.imul(hash, 31) + colour) | 0;
      if (data[i + 3] < 200) continue;
      if (colours.size < most) colours.add(colour);
      ++covered;
    }
    return { hash, covered, colours: colours.size };
  }, kManyColours);
};

const kNear = 3; // of 255: lines are blended with what lies below

/** The number of pixels that have a colour of page.css, and the place of one in their middle. */
export const pixels_of = (page, name) =>
  by(page, "folding-canvas").evaluate(
    (canvas, [variable, near]) => {
      const copy = Object.assign(document.createElement("canvas"), {
        width: canvas.width,
        height: canvas.height,
      });
      const pen = copy.getContext("2d", { willReadFrequently: true });
      pen.fillStyle = getComputedStyle(document.documentElement).getPropertyValue(variable).trim();
      pen.fillRect(0, 0, 1, 1);
      const wanted = [...pen.getImageData(0, 0, 1, 1).data];
      pen.clearRect(0, 0, 1, 1);
      pen.drawImage(canvas, 0, 0);
      const { data } = pen.getImageData(0, 0, copy.width, copy.height),
        found = [];
      for (let i = 0; i < data.length; i += 4)
        if (wanted.every((value, k) => Math.abs(data[i + k] - value) <= near)) found.push(i / 4);
      const middle = found[Math.floor(found.length / 2)] ?? 0,
        shrink = canvas.clientWidth / canvas.width;
      return {
        count: found.length,
        x: (middle % copy.width) * shrink,
        y: Math.floor(middle / copy.width) * shrink,
      };
    },
    [`--${name}`, kNear],
  );

/** The map from values to pixels of an axis, from where its ticks are written; `of`: Math.log10. */
export async function axis(box, which, of = (value) => value) {
  const ticks = await box
    .locator(`g[aria-label^="${which}-axis tick label"] text`)
    .evaluateAll((nodes) =>
      nodes.map((node) => {
        const number_of = (text) => {
          const power = /^10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)$/.exec(text);
          if (!power) return Number(text.replaceAll(",", "").replace("−", "-"));
          return (
            10 **
            Number(power[1].replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹".indexOf(c) - 1).replace("-1", "-"))
          );
        };
        const [, x, y] = /translate\(([-\d.]+),([-\d.]+)\)/.exec(node.getAttribute("transform"));
        return {
          value: number_of(node.textContent),
          x: Number(x),
          y: Number(y),
        };
      }),
    );
  // Charts of the folding have a second axis on the other side: the first one counts.
  const across = which === "x" ? "y" : "x",
    first = ticks[0],
    last = ticks.filter((tick) => tick[across] === first[across]).at(-1);
  assert.ok(ticks.length > 1 && last.value !== first.value, `the ${which} axis has no ticks`);
  // The labels stand half a pixel off where the values are.
  return (value) =>
    first[which] +
    ((of(value) - of(first.value)) * (last[which] - first[which])) /
      (of(last.value) - of(first.value));
}

/** A check that begins with no filter, whatever the one before left. */
export const unfiltered = (page, what, run) =>
  check(what, async () => {
    await by(page, "filter").fill("");
    return run();
  });
