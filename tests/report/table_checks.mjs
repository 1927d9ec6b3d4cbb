// The candidates' table: its filter, its order, its rows.
import assert from "node:assert/strict";
import { by, floats, median, state, unfiltered } from "./reading.mjs";

const filter = async (page, text) => {
  await by(page, "filter").fill(text);
  return (await state(page)).filtered;
};
const first_draw = (page) => by(page, "grid").locator(".line").first().getAttribute("data-draw");

async function document_check(page, { candidates: { shown } }) {
  await unfiltered(page, "only the rows in view are in the document", async () => {
    const lines = await by(page, "grid").locator(".line").count();
    assert.ok(lines > 0 && lines < 60 && lines <= shown, `${lines} rows`);
    return `${lines} of ${shown}`;
  });
}

/** Conditions, and which rows they leave. */
function conditions({ candidates: { columns }, actuators, details }) {
  const stroke = median(columns.stroke_max),
    depth = median(columns.deploys_from_deg),
    few = median(columns.shifted_vertices),
    springs = actuators.stiffness_n_per_mm / 2,
    energy = springs * median(columns.stretch_sq_mm2);
  return [
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
    [`Largest stroke < ${stroke}`, (i) => columns.stroke_max[i] < stroke],
    [
      `bump = none Largest elongation < ${100 * stroke} %`,
      (i) => columns.bump_deg[i] === null && columns.elongation_max[i] < (100 * stroke) / 100,
    ],
    [`energy_n_mm < ${energy}`, (i) => springs * columns.stretch_sq_mm2[i] < energy],
    [`D > ${depth}`, (i) => columns.deploys_from_deg[i] > depth],
    ["details", (i) => details.some(({ draw }) => draw === columns.draw[i])],
    ["stroke_max < -1", () => false],
  ];
}

async function filter_check(page, data) {
  const { columns } = data.candidates,
    rows = columns.draw.map((_, i) => i),
    cases = conditions(data);
  await unfiltered(page, "the filter leaves what the data say", async () => {
    for (const [text, test] of cases) {
      const left = rows.filter(test).length;
      assert.equal(await filter(page, text), left, text);
      if (left < rows.length)
        assert.match(
          await by(page, "filter-says").textContent(),
          new RegExp(`^${left.toLocaleString("en")} of`),
          text,
        );
    }
    assert.equal(
      await by(page, "grid").locator(".line").count(),
      0,
      "rows although none meets the conditions",
    );
    assert.equal(await filter(page, ""), rows.length);
    return `${cases.length} conditions`;
  });
}

async function energy_check(page, data) {
  const { columns } = data.candidates,
    springs = data.actuators.stiffness_n_per_mm / 2;
  await unfiltered(page, "the energy of a row is that of its springs", async () => {
    for (const detail of data.details) {
      const row = columns.draw.indexOf(detail.draw),
        depth = detail.pilot_deg.indexOf(detail.verdict.deploys_from_deg);
      if (row < 0) continue;
      const stored = floats(detail.energy_n_mm)[depth];
      assert.ok(Math.abs(springs * columns.stretch_sq_mm2[row] - stored) < 1e-5 * stored, "energy");
    }
  });
}

async function mistake_check(page, data) {
  const own = Object.keys(data.candidates.columns).find((name) => name.includes("friction"));
  await unfiltered(
    page,
    "mistakes in the filter are said in words, and change nothing",
    async () => {
      for (const [text, words] of [
        ["strok_max < 1", /no column.*stroke_max/],
        ["stroke_max <", /number is missing/],
        ["stroke_max < x", /not a number/],
        ["stroke_max 5", /comparison is missing/],
        ["stroke_max < 5", /is a share: write 5%/],
        ["< 5", /name is missing/],
        ["stroke_max < 1 or bump_deg = none", /“or” is not understood/],
        ["stroke_max ! 5", /not understood/],
        // No column is proposed that the page has not.
        ["friction < 1", own ? new RegExp(`did you mean “${own}”`) : /page.*--column \w*friction/],
        ["friction < 1", /--column static_friction_n_mm_per_mm/],
        ["static_friction_n_mm_per_mm > 0.1", /^This page lacks .*--column static_friction/],
        ["static_frictoin_n_mm_per_mm > 0.1", /no column.*--column static_friction/],
        ["static friction, bent > 0.1", /^This page lacks .*--column static_friction/],
        ["stall_deg", /^This page lacks .*--column stall_deg/],
      ]) {
        await by(page, "filter").fill(text);
        assert.match(await by(page, "filter-says").textContent(), words, text);
        assert.equal(await by(page, "filter").getAttribute("aria-invalid"), "true");
        assert.equal((await state(page)).filtered, data.candidates.columns.draw.length, text);
      }
      await filter(page, "");
    },
  );
}

async function order_check(page, data) {
  const { columns } = data.candidates,
    rows = columns.draw.map((_, i) => i);
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
      assert.equal(await first_draw(page), extreme(name, best), name);
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), second, name);
      assert.equal(await first_draw(page), extreme(name, -best), name);
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), "none", name);
      assert.equal(await first_draw(page), columns.draw[0]);
    }
    await by(page, "head-draw").locator("button").click();
    assert.equal(
      await first_draw(page),
      columns.draw.reduce((a, b) => (BigInt(b) < BigInt(a) ? b : a)),
      "draws as numbers, all digits",
    );
    await by(page, "head-bump_deg").locator("button").click();
    const bump = columns.bump_deg[columns.draw.indexOf(await first_draw(page))];
    if (columns.bump_deg.includes(null)) assert.equal(bump, null, "the best have no bump");
    await by(page, "head-rank").locator("button").click();
  });
}

async function picking_check(page, data) {
  const { columns, shown } = data.candidates;
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

/** The headings' words as names of columns, and the field's word on what it cannot read. */
async function filter_word_checks(page, data) {
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

const heads = (page) =>
  by(page, "grid")
    .locator("[data-sort]")
    .evaluateAll((nodes) => nodes.map((node) => node.dataset.sort));

/** Columns that are left out, and moved by dragging and by keys; the address keeps the choice. */
async function column_check(page) {
  await unfiltered(page, "columns are chosen and moved, and the address keeps it", async () => {
    const all = await heads(page),
      [first, second, third] = all.slice(2);
    assert.deepEqual(all.slice(0, 2), ["rank", "draw"]);
    await page.getByText("Choose columns").click();
    await by(page, `show-${second}`).uncheck();
    assert.deepEqual(
      await heads(page),
      all.filter((name) => name !== second),
    );
    assert.equal(await by(page, "grid").getAttribute("aria-colcount"), String(all.length - 1));
    const cells = await by(page, "grid").locator(".line").first().locator("> *").count();
    assert.equal(cells, all.length - 1);
    await by(page, `show-${second}`).check(); // comes back last
    assert.equal((await heads(page)).at(-1), second);
    await by(page, "all-columns").click();
    assert.deepEqual(await heads(page), all);
    // Both headings are in view: a browser that scrolls with the button down drags what comes under the mouse.
    await by(page, `head-${second}`).dragTo(by(page, `head-${first}`));
    assert.deepEqual((await heads(page)).slice(2, 4), [second, first]);
    await by(page, `head-${second}`).locator("button").focus();
    await page.keyboard.press("Alt+ArrowRight");
    assert.deepEqual(await heads(page), all);
    await page.keyboard.press("Alt+ArrowRight");
    assert.deepEqual((await heads(page)).slice(2, 5), [first, third, second]);
    const is_kept = ([a, b, c]) =>
      new URLSearchParams(location.hash.slice(1)).get("columns")?.startsWith(`${a},${b},${c}`);
    await page.waitForFunction(is_kept, [first, third, second]);
    const focused = await page.evaluate(() => document.activeElement.dataset.sort);
    assert.equal(focused, second, "the moved heading keeps the focus");
    await by(page, "all-columns").click();
    assert.deepEqual(await heads(page), all);
    await page.getByText("Choose columns").click();
    return `${all.length} columns`;
  });
}

export async function table_checks(page, data) {
  await column_check(page);

  await document_check(page, data);
  await filter_check(page, data);
  await energy_check(page, data);
  await filter_word_checks(page, data);
  await mistake_check(page, data);
  await order_check(page, data);
  await picking_check(page, data);
}
