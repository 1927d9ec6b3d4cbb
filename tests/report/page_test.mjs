// Drives the pages of `misalign report` as a reader would, offline, in the system's Chromium:
//   node page_test.mjs REPORT.html...
// What a page shows is compared with the data inside it, read here without the page's code.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { open_browser, open_page } from "./browser.mjs";

const reports = process.argv.slice(2);
if (reports.length === 0) {
  console.error("usage: node page_test.mjs REPORT.html...");
  process.exit(2);
}

let failures = 0,
  checks = 0;
async function check(what, run) {
  ++checks;
  try {
    const said = await run();
    console.log(`ok    ${what}${said ? `: ${said}` : ""}`);
  } catch (error) {
    ++failures;
    console.log(
      `FAIL  ${what}\n      ${String(error.message).split("\n").slice(0, 6).join("\n      ")}`,
    );
  }
}

function data_of(report) {
  const text = readFileSync(report, "utf8"),
    open = '<script type="application/json" id="report-data">';
  const start = text.indexOf(open) + open.length;
  return JSON.parse(text.slice(start, text.indexOf("</script>", start)));
}

const floats = (base64) => {
  const bytes = Buffer.from(base64, "base64");
  return Array.from({ length: bytes.length / 4 }, (_, i) => bytes.readFloatLE(4 * i));
};
const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];
const by = (page, id) => page.getByTestId(id);
const state = (page) =>
  page.evaluate(() => ({
    picked: misalign.picked,
    pilot_deg: misalign.pilot_deg,
    filtered: misalign.filtered,
  }));
const eventually = async (page, wanted, what) => {
  try {
    await page.waitForFunction(wanted.test, wanted.with, { timeout: 5000 });
  } catch {
    assert.fail(what);
  }
};

/** Pixels of a canvas: a hash, and how many colours there are. */
const pixels = (locator) =>
  locator.evaluate((canvas) => {
    const copy = Object.assign(document.createElement("canvas"), {
      width: canvas.width,
      height: canvas.height,
    });
    const pen = copy.getContext("2d");
    pen.drawImage(canvas, 0, 0);
    const { data } = pen.getImageData(0, 0, copy.width, copy.height),
      colours = new Set();
    let hash = 0;
    for (let i = 0; i < data.length; i += 4) {
      const colour = data[i] | (data[i + 1] << 8) | (data[i + 2] << 16) | (data[i + 3] << 24);
      hash = (Math.imul(hash, 31) + colour) | 0;
      if (data[i + 3] > 200) colours.add(colour);
    }
    return { hash, colours: colours.size };
  });

/** The map from values to pixels of an axis, from where its ticks are written. */
async function axis(box, which) {
  const ticks = await box
    .locator(`g[aria-label^="${which}-axis tick label"] text`)
    .evaluateAll((nodes) =>
      nodes.map((node) => {
        const [, x, y] = /translate\(([-\d.]+),([-\d.]+)\)/.exec(node.getAttribute("transform"));
        return {
          value: Number(node.textContent.replaceAll(",", "").replace("−", "-")),
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
    ((value - first.value) * (last[which] - first[which])) / (last.value - first.value);
}

/** A check that begins with no filter, whatever the one before left. */
const unfiltered = (page, what, run) =>
  check(what, async () => {
    await by(page, "filter").fill("");
    return run();
  });

async function table_checks(page, data) {
  const { columns, shown } = data.candidates;
  const rows = columns.draw.map((_, i) => i);
  const filter = async (text) => {
    await by(page, "filter").fill(text);
    return (await state(page)).filtered;
  };
  const expected = (test) => rows.filter(test).length;

  await unfiltered(page, "only the rows in view are in the document", async () => {
    const lines = await by(page, "grid").locator(".line").count();
    assert.ok(lines > 0 && lines < 60 && lines <= shown, `${lines} rows`);
    return `${lines} of ${shown}`;
  });

  await unfiltered(page, "the filter leaves what the data say", async () => {
    const stroke = median(columns.stroke_max),
      depth = median(columns.deploys_from_deg),
      few = median(columns.shifted_vertices);
    const cases = [
      [`stroke_max < ${stroke}`, (i) => columns.stroke_max[i] < stroke],
      [
        `stroke_max<${stroke} deploys_from_deg >= ${depth}`,
        (i) => columns.stroke_max[i] < stroke && columns.deploys_from_deg[i] >= depth,
      ],
      [
        `stroke_max ≥ ${stroke * 100}% and shifted_vertices <= ${few}`,
        (i) => columns.stroke_max[i] >= (stroke * 100) / 100 && columns.shifted_vertices[i] <= few,
      ],
      [
        `${depth} < deploys_from_deg <= ${depth + 3}`,
        (i) => columns.deploys_from_deg[i] > depth && columns.deploys_from_deg[i] <= depth + 3,
      ],
      ["bump_deg = none", (i) => columns.bump_deg[i] === null],
      ["bump_deg > 0", (i) => columns.bump_deg[i] !== null && columns.bump_deg[i] > 0],
      [`draw = ${columns.draw.at(-1)}`, (i) => columns.draw[i] === columns.draw.at(-1)],
      ["details", (i) => data.details.some(({ draw }) => draw === columns.draw[i])],
      ["stroke_max < -1", () => false],
    ];
    for (const [text, test] of cases) {
      assert.equal(await filter(text), expected(test), text);
      if (expected(test) < rows.length)
        assert.match(
          await by(page, "filter-says").textContent(),
          new RegExp(`^${expected(test).toLocaleString("en")} of`),
          text,
        );
    }
    assert.equal(
      await by(page, "grid").locator(".line").count(),
      0,
      "rows although none meets the conditions",
    );
    assert.equal(await filter(""), rows.length);
    return `${cases.length} conditions`;
  });

  await unfiltered(
    page,
    "mistakes in the filter are said in words, and change nothing",
    async () => {
      for (const [text, words] of [
        ["strok_max < 1", /no column.*stroke_max/],
        ["stroke_max <", /number is missing/],
        ["stroke_max < x", /no number/],
        ["stroke_max 5", /comparison is missing/],
        ["< 5", /name is missing/],
        ["stroke_max < 1 or bump_deg = none", /“or” is not understood/],
        ["stroke_max ! 5", /not understood/],
      ]) {
        await by(page, "filter").fill(text);
        assert.match(await by(page, "filter-says").textContent(), words, text);
        assert.equal(await by(page, "filter").getAttribute("aria-invalid"), "true");
        assert.equal((await state(page)).filtered, rows.length, text);
      }
      await filter("");
    },
  );

  const first_draw = () => by(page, "grid").locator(".line").first().getAttribute("data-draw");
  await unfiltered(page, "columns sort, up, down and back, by mouse and keyboard", async () => {
    const sorted = (name, sign) => {
      const with_value = rows.filter((i) => columns[name][i] !== null);
      return columns.draw[
        with_value.reduce((best, i) =>
          sign * (columns[name][i] - columns[name][best]) < 0 ? i : best,
        )
      ];
    };
    const head = by(page, "head-stroke_min");
    await head.locator("button").click();
    assert.equal(await head.getAttribute("aria-sort"), "ascending");
    assert.equal(await first_draw(), sorted("stroke_min", 1));
    await page.keyboard.press("Enter");
    assert.equal(await head.getAttribute("aria-sort"), "descending");
    assert.equal(await first_draw(), sorted("stroke_min", -1));
    await page.keyboard.press("Enter");
    assert.equal(await head.getAttribute("aria-sort"), "none");
    assert.equal(await first_draw(), columns.draw[0]);
    await by(page, "head-draw").locator("button").click();
    assert.equal(
      await first_draw(),
      columns.draw.reduce((a, b) => (BigInt(b) < BigInt(a) ? b : a)),
      "draws as numbers, all digits",
    );
    await by(page, "head-rank").locator("button").click();
  });

  await unfiltered(
    page,
    "rows are picked by click and arrow keys, and come into view",
    async () => {
      await by(page, "grid")
        .locator(".line")
        .nth(Math.min(2, shown - 1))
        .click();
      const third = Math.min(2, shown - 1);
      assert.equal((await state(page)).picked, columns.draw[third]);
      await by(page, "grid").focus();
      await page.keyboard.press("Home");
      assert.equal((await state(page)).picked, columns.draw[0]);
      await page.keyboard.press("ArrowDown");
      assert.equal((await state(page)).picked, columns.draw[Math.min(1, shown - 1)]);
      await page.keyboard.press("ArrowUp");
      await page.keyboard.press("End");
      assert.equal((await state(page)).picked, columns.draw.at(-1));
      const last = by(page, "grid").locator(`[data-draw="${columns.draw.at(-1)}"]`);
      await last.waitFor();
      assert.equal(await last.getAttribute("aria-selected"), "true");
      const [row, grid] = [await last.boundingBox(), await by(page, "grid").boundingBox()];
      assert.ok(
        row.y >= grid.y && row.y + row.height <= grid.y + grid.height + 1,
        "the picked row is not in view",
      );
      await by(page, "grid").focus();
      await page.keyboard.press("Home");
    },
  );
}

async function scatter_checks(page, data) {
  const { columns } = data.candidates;
  const across = "stroke_max",
    up = "elongation_max";
  await unfiltered(
    page,
    "a click on the scatter picks the nearest, of those that the filter leaves",
    async () => {
      await by(page, "scatter-x").selectOption(across);
      await by(page, "scatter-y").selectOption(up);
      const box = by(page, "scatter"),
        canvas = by(page, "scatter-canvas");
      await canvas.scrollIntoViewIfNeeded();
      const [x, y] = [await axis(box, "x"), await axis(box, "y")];
      const points = columns.draw.map((draw, i) => ({
        draw,
        x: x(100 * columns[across][i]),
        y: y(100 * columns[up][i]),
        filtered: columns[up][i],
      }));
      const nearest = (to, among) =>
        among.reduce((best, p) =>
          (p.x - to.x) ** 2 + (p.y - to.y) ** 2 < (best.x - to.x) ** 2 + (best.y - to.y) ** 2
            ? p
            : best,
        );
      const lonely = points
        .map((p) => ({
          p,
          away: Math.min(
            ...points.filter((q) => q !== p).map((q) => Math.hypot(p.x - q.x, p.y - q.y)),
            1e9,
          ),
        }))
        .sort((a, b) => b.away - a.away)
        .slice(0, 3)
        .map(({ p }) => p);
      for (const p of lonely) {
        await canvas.click({ position: { x: p.x + 1, y: p.y + 1 } });
        assert.equal((await state(page)).picked, p.draw);
      }
      for (const [across_px, up_px] of [
        [0.3, 0.3],
        [0.5, 0.6],
        [0.7, 0.2],
        [0.8, 0.8],
      ]) {
        const { width, height } = await canvas.boundingBox(),
          place = { x: across_px * width, y: up_px * height };
        await canvas.click({ position: place });
        const { picked } = await state(page),
          away = (q) => Math.hypot(q.x - place.x, q.y - place.y);
        assert.ok(
          away(points.find(({ draw }) => draw === picked)) < away(nearest(place, points)) + 2,
          `a click at ${place.x}, ${place.y}`,
        );
      }
      const [p] = lonely,
        limit = median(columns[up]);
      const condition = p.filtered < limit ? `${up} >= ${limit}` : `${up} < ${limit}`;
      const kept = points.filter((q) =>
        p.filtered < limit ? q.filtered >= limit : q.filtered < limit,
      );
      await by(page, "filter").fill(condition);
      await canvas.click({ position: { x: p.x, y: p.y } });
      const { picked } = await state(page),
        q = kept.find(({ draw }) => draw === picked);
      if (kept.length) {
        const away = (r) => Math.hypot(r.x - p.x, r.y - p.y);
        assert.ok(
          q && away(q) < away(nearest(p, kept)) + 2,
          "the filter does not hold in the scatter",
        );
      }
      await by(page, "filter").fill("");
    },
  );

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

async function detail_checks(page, data, detail, webgl = true) {
  const canvas = by(page, "folding-canvas"),
    slider = by(page, "pilot");
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
      seen.add((await pixels(canvas)).hash);
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
    }
    assert.equal(
      seen.size,
      Math.min(4, new Set([0, Math.floor(n / 3), Math.floor((2 * n) / 3), n - 1]).size),
      "the sheet's pictures",
    );
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

  await check("energy and moment on a logarithmic scale", async () => {
    const line = () =>
      Promise.all(
        ["energy", "moment", "advantage"].map((id) =>
          by(page, id).locator("path.value").first().getAttribute("d"),
        ),
      );
    const before = await line();
    await by(page, "log").check();
    const after = await line();
    if (detail.weakest?.moment_n_mm > 0) assert.notEqual(after[1], before[1], "moment");
    assert.notEqual(after[0], before[0], "energy");
    assert.equal(after[2], before[2], "mechanical advantage");
    await by(page, "log").uncheck();
    assert.deepEqual(await line(), before);
  });

  await check("forces run through the data", async () => {
    const depth = detail.pilot_deg.findLastIndex(
      (pilot) => pilot <= detail.verdict.deploys_from_deg + 1e-9,
    );
    for (const [id, values] of [
      ["energy", floats(detail.energy_n_mm)],
      ["moment", floats(detail.moment_n_mm)],
    ]) {
      const y = await axis(by(page, id), "y");
      const path = await by(page, id).locator("path.value").first().getAttribute("d"),
        [, py] = path.split(/[ML]/).at(-1).split(",").map(Number);
      assert.ok(Math.abs(py - y(values[depth])) < 1, `${id} at D`);
    }
  });

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

async function no_detail_checks(page, data) {
  const bares = data.candidates.columns.draw.filter(
    (draw) => !data.details.some((detail) => detail.draw === draw),
  );
  if (bares.length === 0) return;
  const bare = bares.find((draw) => String(Number(draw)) !== draw) ?? bares[0]; // all of its digits count
  await unfiltered(
    page,
    "a row without details shows its metrics and the command that brings them",
    async () => {
      await by(page, "filter").fill(`draw = ${bare}`);
      await by(page, "grid").locator(".line").first().click();
      const { misalign, catalogue, output } = data.commands;
      assert.equal(
        await by(page, "command-report").textContent(),
        `${misalign} report ${catalogue} --draw ${bare} --output ${output}`,
      );
      assert.equal(
        await by(page, "command-replay").textContent(),
        `${misalign} replay ${catalogue} ${bare}`,
      );
      assert.ok(await by(page, "no-details").isVisible());
      assert.ok(!(await by(page, "folding").isVisible()));
      assert.equal((await state(page)).pilot_deg, null);
      const row = data.candidates.columns.draw.indexOf(bare);
      assert.ok(
        (await by(page, "metrics").textContent()).includes(
          `${(100 * data.candidates.columns.stroke_max[row]).toFixed(2)} %`,
        ),
      );
      await page.evaluate(() =>
        Object.defineProperty(navigator, "clipboard", {
          value: {
            writeText: async (text) => {
              window.copied = text;
            },
          },
        }),
      );
      await by(page, "no-details").getByTestId("copy").click();
      assert.equal(
        await page.evaluate(() => window.copied),
        `${misalign} report ${catalogue} --draw ${bare} --output ${output}`,
      );
      await by(page, "filter").fill("");
    },
  );
}

async function report_checks(browser, report) {
  const data = data_of(report),
    shown = data.candidates.columns.draw?.length ?? 0;
  console.log(
    `\n${report}: ${data.campaign.name}, ${shown} candidates, ${data.details.length} with details`,
  );
  const { page, context, problems, load_ms } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
    colorScheme: "light",
  });
  console.log(`      loaded in ${load_ms.toFixed(0)} ms`);

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
    if (data.state.acceptance.rate > 0)
      assert.match(figures, /Acceptance rate[\d.,]+ %95 %: [\d.,]+ % – [\d.,]+ %/);
  });

  const sampled = data.faults.rows.reduce((total, row) => total + row.draws, 0);
  if (sampled > 0) {
    await check("faults along the folding and on the sheet", async () => {
      assert.ok(
        (await by(page, "sample-note").textContent()).includes(sampled.toLocaleString("en")),
        "the sample's size",
      );
      assert.ok(
        (await by(page, "sample-note").textContent()).includes("1,024"),
        "one draw in 1,024",
      );
      const bins = new Set(
        data.faults.rows
          .filter((row) => row.fault_deg !== null && row.first_fault !== "none")
          .map(
            (row) =>
              `${row.first_fault} ${Math.ceil(row.fault_deg / Math.max(5, data.campaign.configuration.path.sample_deg))}`,
          ),
      );
      assert.equal(
        await by(page, "faults").locator('g[aria-label="rect"] rect').count(),
        bins.size,
        "bars",
      );
      const places = new Map();
      for (const { where, draws } of data.faults.rows)
        if (where) places.set(where, (places.get(where) ?? 0) + draws);
      if (places.size) {
        const most = Math.max(...places.values());
        const first = (
          await by(page, "where")
            .locator('g[aria-label^="y-axis tick label"] text')
            .first()
            .textContent()
        ).replace("–", "-");
        assert.equal(places.get(first), most, `the first bar, ${first}`);
        const widest = await by(page, "map")
          .locator("[data-where]")
          .evaluateAll(
            (nodes) =>
              nodes
                .map((node) => [parseFloat(node.style.strokeWidth), node.dataset.where])
                .sort((a, b) => b[0] - a[0])[0][1],
          );
        assert.equal(places.get(widest), most, `the map's strongest line, ${widest}`);
      }
      assert.ok(await by(page, "survival").locator("svg").count(), "survival");
    });
  }

  if (shown > 0) {
    await table_checks(page, data);
    await scatter_checks(page, data);
    await no_detail_checks(page, data);
  } else {
    await check("without candidates a sentence says what to do", async () => {
      assert.match(
        await by(page, "candidates-note").textContent(),
        /search again|Run the same search/,
      );
      assert.ok(!(await page.locator("#chooser").isVisible()));
    });
  }
  for (const detail of data.details.slice(0, 2)) await detail_checks(page, data, detail);

  await check("light and dark, by the system and by the button", async () => {
    const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    const light = await ground();
    await page.emulateMedia({ colorScheme: "dark" });
    await eventually(
      page,
      { test: (was) => getComputedStyle(document.body).backgroundColor !== was, with: light },
      "the system's change is not followed",
    );
    const dark = await ground();
    await by(page, "theme").click();
    assert.equal(await ground(), light);
    await page.reload();
    assert.equal(await ground(), light, "the choice is not remembered");
    await by(page, "theme").click();
    assert.equal(await ground(), dark);
  });

  await check("prints light, and returns to dark", async () => {
    await page.evaluate(() =>
      addEventListener("beforeprint", () => {
        window.printed = document.documentElement.dataset.theme;
      }),
    );
    const pdf = await page.pdf();
    assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
    assert.equal(await page.evaluate(() => window.printed), "light");
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    return `${(pdf.length / 1024).toFixed(0)} KiB`;
  });

  await check("a narrow window needs no sideways scrolling", async () => {
    await page.setViewportSize({ width: 800, height: 900 });
    await page.waitForTimeout(200);
    assert.ok(
      await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth),
      "wider than the window",
    );
  });

  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await context.close();
}

async function without_storage(browser, report) {
  await check("without storage: still works", async () => {
    const context = await browser.newContext({ colorScheme: "light" }),
      page = await context.newPage(),
      errors = [];
    page.on("pageerror", (error) => errors.push(error.message));
    await page.addInitScript(() =>
      Object.defineProperty(window, "localStorage", {
        get() {
          throw new Error("no storage");
        },
      }),
    );
    await page.goto(new URL(report, `file://${process.cwd()}/`).href);
    await page.waitForFunction(() => window.misalign !== undefined);
    await by(page, "theme").click();
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    assert.deepEqual(errors, []);
    await context.close();
  });
}

async function without_webgl(report) {
  const data = data_of(report);
  if (data.details.length === 0) return;
  console.log(`\n${report}, without WebGL`);
  const browser = await open_browser(["--disable-3d-apis"]);
  const { page, problems } = await open_page(browser, report, {
    viewport: { width: 1400, height: 900 },
  });
  await check("it is without WebGL, and says so", async () => {
    assert.equal(
      await page.evaluate(() => document.createElement("canvas").getContext("webgl2")),
      null,
    );
    assert.match(await page.locator("#folding-caption").textContent(), /no WebGL/);
  });
  await detail_checks(page, data, data.details[0], false);
  await check("no errors, no requests", async () => assert.deepEqual(problems, []));
  await browser.close();
}

const browser = await open_browser();
for (const report of reports) await report_checks(browser, report);
await without_storage(browser, reports[0]);
await browser.close();
const detailed = reports.find((report) => data_of(report).details.length > 0);
if (detailed) await without_webgl(detailed);
console.log(`\n${checks - failures} of ${checks} checks passed`);
process.exit(failures ? 1 : 0);
