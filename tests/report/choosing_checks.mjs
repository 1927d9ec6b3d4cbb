// Table, filter and scatter of the candidates, and rows without details.
import assert from "node:assert/strict";
import { axis, by, floats, median, state, unfiltered } from "./reading.mjs";

export async function table_checks(page, data) {
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
      few = median(columns.shifted_vertices),
      springs = data.actuators.stiffness_n_per_mm / 2,
      energy = springs * median(columns.stretch_sq_mm2);
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
      [`${columns.draw[0]}`, (i) => columns.draw[i] === columns.draw[0]],
      [`Stroke max < ${stroke}`, (i) => columns.stroke_max[i] < stroke],
      [
        `bump = none Longest < ${100 * stroke} %`,
        (i) => columns.bump_deg[i] === null && columns.elongation_max[i] < (100 * stroke) / 100,
      ],
      [`energy_n_mm < ${energy}`, (i) => springs * columns.stretch_sq_mm2[i] < energy],
      ["details", (i) => data.details.some(({ draw }) => draw === columns.draw[i])],
      ["stroke_max < -1", () => false],
    ];
    for (const detail of data.details) {
      const row = columns.draw.indexOf(detail.draw),
        depth = detail.pilot_deg.indexOf(detail.verdict.deploys_from_deg);
      if (row < 0) continue;
      const stored = floats(detail.energy_n_mm)[depth];
      assert.ok(Math.abs(springs * columns.stretch_sq_mm2[row] - stored) < 1e-5 * stored, "energy");
    }
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
        ["stroke_max < 5", /is a share: write 5%/],
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
  await unfiltered(page, "columns sort best first, worst first and back", async () => {
    const extreme = (name, sign) => {
      const with_value = rows.filter((i) => columns[name][i] !== null);
      return columns.draw[
        with_value.reduce((best, i) =>
          sign * (columns[name][i] - columns[name][best]) < 0 ? i : best,
        )
      ];
    };
    // Much of a stroke that every diagonal makes is good, much of what one actuator must make is not.
    for (const [name, best, first, second] of [
      ["stroke_min", -1, "descending", "ascending"],
      ["stroke_max", 1, "ascending", "descending"],
      ["shifted_vertices", 1, "ascending", "descending"],
    ]) {
      const head = by(page, `head-${name}`);
      await head.locator("button").click();
      assert.equal(await head.getAttribute("aria-sort"), first, name);
      assert.equal(await first_draw(), extreme(name, best), name);
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), second, name);
      assert.equal(await first_draw(), extreme(name, -best), name);
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), "none", name);
      assert.equal(await first_draw(), columns.draw[0]);
    }
    await by(page, "head-draw").locator("button").click();
    assert.equal(
      await first_draw(),
      columns.draw.reduce((a, b) => (BigInt(b) < BigInt(a) ? b : a)),
      "draws as numbers, all digits",
    );
    await by(page, "head-bump_deg").locator("button").click();
    const bump = columns.bump_deg[columns.draw.indexOf(await first_draw())];
    if (columns.bump_deg.includes(null)) assert.equal(bump, null, "the best have no bump");
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

export async function scatter_checks(page, data) {
  const { columns } = data.candidates;
  await unfiltered(page, "points and axes of the scatter lie on each other", async () => {
    const [points, axes] = [
      await by(page, "scatter-canvas").boundingBox(),
      await by(page, "scatter").locator("svg.plot").boundingBox(),
    ];
    for (const side of ["x", "y", "width", "height"])
      assert.ok(Math.abs(points[side] - axes[side]) < 1, `${side}: ${points[side]}, ${axes[side]}`);
  });
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

export async function no_detail_checks(page, data) {
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
      const { misalign, catalogue, choice, springs, output } = data.commands;
      assert.equal(
        await by(page, "command-report").textContent(),
        `${misalign} report ${catalogue} --draw ${bare}${choice}${springs} --output ${output}`,
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
        `${misalign} report ${catalogue} --draw ${bare}${choice}${springs} --output ${output}`,
      );
      await by(page, "filter").fill("");
    },
  );
  await unfiltered(page, "a button says “Copied” for a while, however often it is clicked", async () => {
    await by(page, "filter").fill(`draw = ${bare}`);
    await by(page, "grid").locator(".line").first().click();
    const button = by(page, "no-details").getByTestId("copy");
    await page.evaluate(() => {
      const timeout = setTimeout;
      window.later = [];
      window.setTimeout = (run, ms) => (ms > 1000 ? void later.push(run) : timeout(run, ms));
      window.time_goes_by = () => {
        for (const run of later) run();
        window.setTimeout = timeout;
      };
    });
    await button.dblclick();
    assert.equal(await button.textContent(), "Copied");
    await page.evaluate(() => time_goes_by());
    assert.equal(await button.textContent(), "Copy", "it says so for good");
  });
}

/** The headings' words as names of columns, and the field's word on what it cannot read. */
export async function filter_word_checks(page, data) {
  const { columns } = data.candidates;
  await unfiltered(page, "every heading of the table can stand in a condition", async () => {
    const names = await page
      .locator("#filter-help dl.columns dt")
      .evaluateAll((nodes) =>
        nodes.map((node) => [
          node.firstChild.textContent,
          node.textContent.slice(node.firstChild.textContent.length + 1),
        ]),
      );
    assert.ok(names.some(([, label]) => label.includes("±")));
    for (const [name, label] of names) {
      if (label === "") continue; // the number of the draw
      const values = columns[name === "energy_n_mm" ? "stretch_sq_mm2" : name];
      if (!values?.some((value) => value !== null)) continue; // no column of this page
      await by(page, "filter").fill(`${label} = none`);
      assert.equal(await by(page, "filter").getAttribute("aria-invalid"), "false", label);
      const none = values.filter((value) => value === null).length;
      assert.equal((await state(page)).filtered, none, label);
    }
    return `${names.length - 1} headings`;
  });

  await unfiltered(page, "what is wrong with a condition is said until it is mended", async () => {
    await by(page, "filter").fill("strok_max < 1");
    await by(page, "head-stroke_min").locator("button").click();
    assert.match(await by(page, "filter-says").textContent(), /no column/);
    assert.equal(await by(page, "filter").getAttribute("aria-invalid"), "true");
    await by(page, "filter").fill("");
    assert.match(await by(page, "filter-says").textContent(), /candidates$/);
    await by(page, "head-rank").locator("button").click();
  });
}

/** What the table and the scatter look like, whatever is in them. */
export async function layout_checks(page, data) {
  const { columns } = data.candidates;
  await unfiltered(page, "all columns can be reached, and are seen to go on", async () => {
    const grid = by(page, "grid"),
      more = by(page, "table").locator(".side.right");
    for (const width of [2500, 800]) {
      await page.setViewportSize({ width, height: 900 });
      await page.waitForTimeout(150);
      const hidden = await grid.evaluate((node) => node.scrollWidth - node.clientWidth);
      assert.equal(hidden > 1, width === 800, `${hidden} px are hidden at ${width} px`);
      assert.equal(await more.isVisible(), width === 800, `the sign of it at ${width} px`);
    }
    for (let i = 0; i < 9 && (await more.isVisible()); ++i) {
      await more.click({ timeout: 2000 }).catch(() => {}); // it goes with the last column
      await page.waitForTimeout(60);
    }
    const [last, box] = [
      await by(page, "head-isometry_error_mm").boundingBox(),
      await grid.boundingBox(),
    ];
    assert.ok(last.x + last.width <= box.x + box.width + 2, "the last column stays outside");
    await page.setViewportSize({ width: 1400, height: 900 });
    await grid.evaluate((node) => (node.scrollLeft = 0));
    for (const { width, text } of await grid
      .locator(".line")
      .first()
      .locator("> div")
      .evaluateAll((nodes) =>
        nodes.map((node) => ({
          width: node.scrollWidth - node.clientWidth,
          text: node.textContent,
        })),
      ))
      assert.ok(width <= 0, `“${text}” is cut off`);
  });

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
  await unfiltered(page, "one candidate is one candidate", async () => {
    await by(page, "filter").fill(`draw = ${columns.draw[0]}`);
    assert.match(await page.locator("#scatter-note").textContent(), /^1 candidate shown/);
  });
}

/** What `misalign tolerance` found, where it was asked. */
export async function yield_checks(page, data) {
  const { columns } = data.candidates;
  if (!columns.yield) return; // a catalogue from before it was kept
  const head = by(page, "head-yield"),
    tried = columns.draw.filter((_, i) => columns.yield[i] !== null);
  await unfiltered(page, "yields of miscut copies are a column where there are any", async () => {
    assert.equal(await head.count(), tried.length ? 1 : 0);
    if (tried.length === 0) return "none";
    await head.locator("button").click();
    const first = await by(page, "grid").locator(".line").first().getAttribute("data-draw"),
      most = Math.max(...columns.yield.filter((share) => share !== null));
    assert.equal(columns.yield[columns.draw.indexOf(first)], most, "the largest yield first");
    await by(page, "head-rank").locator("button").click();
    return `${tried.length} candidates`;
  });
  await unfiltered(page, "and stand in the candidate's card with what was tried", async () => {
    for (const draw of [...tried.slice(0, 1), columns.draw.find((one) => !tried.includes(one))]) {
      await by(page, "filter").fill(`draw = ${draw}`);
      await by(page, "grid").locator(".line").first().click();
      const entries = data.yields.filter((entry) => entry.draw === draw),
        words = await by(page, "yields").textContent();
      assert.equal(await by(page, "yields").isVisible(), entries.length > 0);
      for (const { amplitude_mm, survivors, trials } of entries)
        assert.ok(
          words.includes(`At ±${amplitude_mm} mm ${survivors} of ${trials} miscut copies`),
          words,
        );
    }
  });
}
