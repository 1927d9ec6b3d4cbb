// A reader keeps of a page its address, and files of what it shows.
/* global misalign -- of the page */
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { film_check } from "./film_check.mjs";
import { by, check, eventually, floats, kManyColours, median, state } from "./reading.mjs";

const address = (page) => page.evaluate(() => location.hash.slice(1));
const address_has = (page, words) =>
  eventually(
    page,
    { test: (wanted) => location.hash.includes(wanted), with: words },
    `the address has no ${words}`,
  );
const picked_is = (page, draw) =>
  eventually(
    page,
    { test: (wanted) => misalign.picked === wanted, with: draw },
    `not draw ${draw}`,
  );

export async function address_checks(page, data) {
  const { columns } = data.candidates,
    [first, second] = [columns.draw.at(-1), columns.draw.at(-2)];
  const limit = median(columns.stroke_max);

  await check("pick, filter and order are in the address, and a reload shows them", async () => {
    await page.evaluate(() => (location.hash = "")); // no angle is kept
    await by(page, "head-stroke_min").locator("button").click();
    await by(page, "scatter-y").selectOption("stretch_sq_mm2");
    await by(page, "filter").fill(`draw = ${first}`);
    await by(page, "grid").locator(".line").first().click();
    await by(page, "filter").fill(`stroke_max < ${limit}`);
    await address_has(page, "stroke_max");
    const words = new URLSearchParams(await address(page)),
      { filtered } = await state(page);
    assert.deepEqual(Object.fromEntries(words), {
      draw: first,
      filter: `stroke_max < ${limit}`,
      sort: "-stroke_min",
      up: "stretch_sq_mm2",
    });
    await page.reload();
    await page.waitForFunction(() => window.misalign !== undefined);
    assert.deepEqual(
      [(await state(page)).picked, (await state(page)).filtered],
      [first, filtered],
      "after a reload",
    );
    assert.equal(await by(page, "filter").inputValue(), `stroke_max < ${limit}`);
    assert.equal(await by(page, "head-stroke_min").getAttribute("aria-sort"), "descending");
    assert.equal(await by(page, "scatter-y").inputValue(), "stretch_sq_mm2");
  });

  await check("the back button goes back from pick to pick, and forward again", async () => {
    const lines = by(page, "grid").locator(".line");
    let other = first;
    for (let k = 0; other === first; ++k) {
      await lines.nth(k).click();
      other = (await state(page)).picked;
    }
    await address_has(page, `draw=${other}`);
    // Only now, however slow the machine is: a filter goes with the pick that is in the address.
    await by(page, "filter").fill(`draw = ${second}`);
    await address_has(page, `filter=draw+%3D+${second}`);
    await page.goBack();
    await picked_is(page, first);
    assert.equal(await by(page, "filter").inputValue(), `stroke_max < ${limit}`);
    await page.goForward();
    await picked_is(page, other);
    assert.equal(await by(page, "filter").inputValue(), `draw = ${second}`);
  });
}

export async function section_checks(page, data) {
  await check("sections are gone to without losing the address", async () => {
    const before = await address(page);
    await page.locator('nav a[href="#overview"]').click();
    assert.ok(
      await page.locator("#overview").evaluate((node) => node.getBoundingClientRect().top < 200),
    );
    assert.equal(await address(page), before);
  });

  await check("an address of what is not here is said, and changes nothing else", async () => {
    await page.evaluate(
      () => (location.hash = "draw=999999999999999999&sort=nonsense&filter=details"),
    );
    await by(page, "address-says").waitFor();
    const words = await by(page, "address-says").textContent();
    assert.match(words, /draw 999999999999999999, sort nonsense/);
    assert.equal(await by(page, "filter").inputValue(), "details");
    await page.evaluate(() => (location.hash = ""));
    await picked_is(page, data.details[0].draw);
    assert.ok(!(await by(page, "address-says").isVisible()));
    assert.equal(await by(page, "filter").inputValue(), "");
  });
}

/** Links that somebody else made: of columns that this report lacks, of rows far down. */
export async function link_checks(page, data) {
  const { columns } = data.candidates,
    known = await by(page, "grid")
      .locator("[data-sort]")
      .evaluateAll((nodes) => nodes.map((node) => node.dataset.sort));
  const lacking = ["yield", "miscut_margin_mm", "goes_back"].filter(
    (name) => !known.includes(name),
  );
  const follow = (words) => page.evaluate((hash) => (location.hash = hash), words);

  await check("an order that the table has no column of is said, and changes nothing", async () => {
    for (const name of lacking) {
      await follow(`sort=-${name}`);
      await eventually(
        page,
        {
          test: (words) => document.getElementById("address-says").textContent.includes(words),
          with: `sort -${name}`,
        },
        `nothing is said of ${name}`,
      );
    }
    await page.reload();
    await page.waitForFunction(() => window.misalign !== undefined);
    assert.equal((await state(page)).filtered, columns.draw.length);
    assert.equal(await by(page, "head-rank").getAttribute("aria-sort"), "ascending");
    await follow("");
    return lacking.join(", ");
  });

  await check("the row that a link picks is in view, whatever the link sorts by", async () => {
    const first = await by(page, "grid").locator(".line").first().getAttribute("data-draw");
    await follow(`draw=${first}&sort=-rank`);
    await picked_is(page, first);
    const in_view = () =>
      by(page, "grid").evaluate((grid) => {
        const row = grid.querySelector('[aria-selected="true"]')?.getBoundingClientRect(),
          frame = grid.getBoundingClientRect();
        return Boolean(row) && row.top >= frame.top && row.bottom <= frame.bottom + 1;
      });
    await by(page, "head-rank").and(page.locator('[aria-sort="descending"]')).waitFor();
    assert.ok(await in_view(), "when it is followed");
    await page.reload();
    await page.waitForFunction(() => window.misalign !== undefined);
    assert.equal((await state(page)).picked, first);
    assert.ok(await in_view(), "when the page begins with it");
    await follow("");
  });
}

/** Name and bytes of the file that a card's button saves. */
async function saved(page, box, kind) {
  const card = page.locator(".card").filter({ has: by(page, box) });
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    card.getByTestId(`save-${kind}`).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

/** Rows of a CSV file without quotes in it. */
const rows_of = (bytes) =>
  bytes
    .toString()
    .trim()
    .split("\r\n")
    .map((line) => line.split(","));

/** The number of a picture's colours, if they are few, as the browser draws it. */
const colours_of = (page, bytes, type) =>
  page.evaluate(
    async ([data, format, most]) => {
      const image = new Image();
      image.src = `data:${format};base64,${data}`;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), {
        width: image.naturalWidth,
        height: image.naturalHeight,
      });
      const pen = canvas.getContext("2d", { willReadFrequently: true });
      pen.drawImage(image, 0, 0);
      const { data: points } = pen.getImageData(0, 0, canvas.width, canvas.height),
        colours = new Set();
      for (let i = 0; i < points.length; i += 4)
        if (colours.size < most)
          colours.add((points[i] << 16) | (points[i + 1] << 8) | points[i + 2]);
      return { width: canvas.width, colours: colours.size };
    },
    [bytes.toString("base64"), type, kManyColours],
  );

async function numbers_check(page, data, detail) {
  const stem = `${data.campaign.name}-${detail.draw}`;
  await check("charts are saved as the numbers in them", async () => {
    const lengths = floats(detail.length_mm),
      count = data.diagonals.length,
      k = Math.floor(detail.pilot_deg.length / 2);
    const histories = await saved(page, "histories", "csv");
    assert.equal(histories.name, `${stem}-diagonals.csv`);
    const [heads, ...rows] = rows_of(histories.bytes);
    assert.equal(rows.length, detail.pilot_deg.length);
    data.diagonals.forEach(({ from, to }, d) => {
      assert.equal(heads[2 + d], `relative_length_${d}_${from}-${to}`);
      const wanted = lengths[k * count + d] / lengths[d];
      assert.ok(Math.abs(Number(rows[k][2 + d]) - wanted) < 1e-6, heads[2 + d]);
    });
    for (const [id, column, values] of [
      ["energy", "energy_n_mm", floats(detail.energy_n_mm)],
      ["moment", "moment_n_mm", floats(detail.moment_n_mm)],
    ]) {
      const [names, ...lines] = rows_of((await saved(page, id, "csv")).bytes);
      assert.deepEqual(names, ["pilot_deg", "deployment_ratio", column]);
      assert.equal(Number(lines[k][0]), detail.pilot_deg[k]);
      assert.ok(Math.abs(Number(lines[k][2]) - values[k]) <= 1e-6 * Math.abs(values[k]), id);
    }
  });
}

/** Draws that stand for more count for more; one that came through has no angle. */
function survivors(rows, angle_deg) {
  const whole = rows.reduce((total, { weight }) => total + weight, 0);
  return (
    rows
      .filter(({ first_fault, fault_deg }) => first_fault === "none" || fault_deg > angle_deg)
      .reduce((total, { weight }) => total + weight, 0) / whole
  );
}

export async function survival_check(page, { faults, campaign }) {
  if (faults.rows.length === 0) return;
  await check("the survival is saved as the sample has it", async () => {
    const [heads, ...rows] = rows_of((await saved(page, "survival", "csv")).bytes);
    assert.deepEqual(heads, ["pilot_deg", "share_without_fault", "low_95", "high_95"]);
    for (const [angle_deg, share, low, high] of rows.map((row) => row.map(Number))) {
      assert.ok(low <= share && share <= high, `${low} ${share} ${high}`);
      const wanted = survivors(faults.rows, angle_deg);
      assert.ok(Math.abs(share - wanted) < 1e-6, `${share} at ${angle_deg}°, not ${wanted}`);
    }
    assert.equal(Number(rows.at(-1)[0]), campaign.configuration.path.end_deg);
  });
}

async function rows_check(page, data) {
  await check("the table is saved as it is filtered and sorted", async () => {
    const { columns } = data.candidates,
      limit = columns.stroke_max[0];
    await by(page, "filter").fill(`stroke_max <= ${limit}`);
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      by(page, "rows-save").click(),
    ]);
    const [heads, ...rows] = rows_of(await readFile(await download.path()));
    const wanted = columns.draw.filter((_, i) => columns.stroke_max[i] <= limit);
    assert.deepEqual(
      rows.map((row) => row[heads.indexOf("draw")]),
      wanted,
    );
    assert.equal(Number(rows[0][heads.indexOf("stroke_min")]), columns.stroke_min[0]);
    await by(page, "filter").fill("");
  });
}

/** A binary glTF whose panels span, in metres, what the flat sheet spans, or less where folded. */
function gltf_check(bytes, { sheet }) {
  assert.equal(bytes.subarray(0, 4).toString(), "glTF");
  assert.equal(bytes.readUInt32LE(8), bytes.length);
  const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)));
  const [panels] = json.meshes,
    { max, min } = json.accessors[panels.primitives[0].attributes.POSITION];
  const [scale] = json.nodes.find(({ name }) => name === "sheet").scale ?? [
    json.nodes.find(({ name }) => name === "sheet").matrix[0],
  ];
  const most_mm = Math.max(...sheet.vertices_mm.map(([x, y]) => Math.hypot(x, y)));
  assert.ok(Math.abs(scale - 1e-3) < 1e-9, `${scale}: millimetres in metres`);
  max.forEach((value, i) => assert.ok(value - min[i] > 1 && value - min[i] < 2 * most_mm));
}

async function pictures_check(page, data, detail) {
  const stem = `${data.campaign.name}-${detail.draw}`;
  await check("charts are saved as pictures", async () => {
    for (const id of ["histories", "moment", "crease-pattern", "scatter"]) {
      const png = await saved(page, id, "png");
      assert.equal(png.bytes.subarray(1, 4).toString(), "PNG", id);
      const picture = await colours_of(page, png.bytes, "image/png");
      assert.ok(picture.width > 600 && picture.colours > 20, `${id}: ${JSON.stringify(picture)}`);
      const svg = await saved(page, id, "svg"),
        text = svg.bytes.toString();
      assert.ok(!/var\(--|class=|href="http/.test(text), `${id}: needs a style sheet`);
      const drawn = await colours_of(page, svg.bytes, "image/svg+xml");
      assert.ok(drawn.colours > 10, `${id}: ${drawn.colours} colours of the SVG`);
    }
  });
  await check("the folding is saved as a wide picture and as glTF", async () => {
    const { pilot_deg } = await state(page);
    await by(page, "view-files").first().click();
    const file_of = async (id) => {
      const [download] = await Promise.all([
        page.waitForEvent("download"),
        by(page, id).first().click(),
      ]);
      return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
    };
    await by(page, "picture-width").first().selectOption("1280");
    const png = await file_of("folding-png");
    assert.equal(png.name, `${stem}-folded-${pilot_deg}deg.png`);
    const picture = await colours_of(page, png.bytes, "image/png");
    assert.equal(picture.width, 1280);
    assert.ok(picture.colours > 20, `${picture.colours} colours`);
    const gltf = await file_of("folding-gltf");
    assert.equal(gltf.name, `${stem}-folded-${pilot_deg}deg.glb`);
    gltf_check(gltf.bytes, data);
    await by(page, "view-files").first().click();
  });
}

export async function saving_checks(page, data) {
  const [detail] = data.details;
  await by(page, "detailed").selectOption(detail.draw);
  await numbers_check(page, data, detail);
  await rows_check(page, data);
  await pictures_check(page, data, detail);
  await film_check(page, `${data.campaign.name}-${detail.draw}`);
}
