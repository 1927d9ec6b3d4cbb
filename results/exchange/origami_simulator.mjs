// FOLD files in Origami Simulator's own page, in the system's Chromium, from a checkout on this machine:
// whether it imports them without complaint, and how far its sheet at 100 % is from the deepest frame.
//   [STEPS=200] node origami_simulator.mjs CHECKOUT BUILD_OF_TESTS/report FILE.fold...
// Prints for each file what the page complains of, and the largest and the root mean square difference of any two vertices'
// distance, in mm.
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { basename, join, normalize, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [checkout, web, ...files] = process.argv.slice(2);
const { open_browser } = await import(pathToFileURL(resolve(web, "browser.mjs")));
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css" };

const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(new URL(request.url, "http://x").pathname));
  try {
    const file = readFileSync(join(checkout, path === "/" ? "index.html" : path));
    response.writeHead(200, { "content-type": types[/\.[a-z]+$/.exec(path)?.[0]] ?? "text/html" }).end(file);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const address = `http://127.0.0.1:${server.address().port}/`;

/** Distances of all pairs of points, one after the other. */
function distances(points) {
  const all = [];
  for (let i = 0; i < points.length; ++i)
    for (let k = 0; k < i; ++k) all.push(Math.hypot(...points[i].map((x, axis) => x - points[k][axis])));
  return all;
}

/** The simulator's sheet, folded in 50 stages of so many steps each, and then left to settle for as many. */
function fold_it(steps) {
  const { model } = globals;
  const points = () => {
    const list = model.getPositionsArray(), all = [];
    for (let i = 0; i < list.length; i += 3) all.push([list[i], list[i + 1], list[i + 2]].map((x) => x / globals.scale));
    return all;
  };
  for (let stage = 1; stage <= 50; ++stage) {
    globals.setCreasePercent(stage / 50);
    globals.shouldChangeCreasePercent = true;
    model.step(steps);
  }
  for (let rest = 1; rest <= 50; ++rest) model.step(steps);
  return points();
}

const browser = await open_browser();
let failures = 0;
for (const file of files) {
  const fold = JSON.parse(readFileSync(file, "utf8")), frame = fold.file_frames.at(-1);
  const page = await (await browser.newContext()).newPage();
  page.setDefaultTimeout(120000);
  const problems = [];
  page.on("pageerror", (error) => problems.push(error.message));
  await page.route("**/*", (route) => route.request().url().startsWith(address) ? route.continue() : route.abort());
  await page.addInitScript(() => { window.gtag = () => {}; });
  await page.goto(address);
  await page.waitForFunction(() => globals.model && globals.pattern && globals.threeView);
  await page.setInputFiles("#fileSelector", file);
  const count = fold.vertices_coords.length;
  await page.waitForFunction((n) => globals.model.getPositionsArray()?.length === 3 * n, count);
  await page.evaluate(() => globals.model.pause());
  const warned = await page.evaluate(() => document.querySelector("#warningMessage").textContent);
  if (warned) problems.push(warned);
  console.log(`${basename(file)}: imported, ${count} vertices; complaints: ${problems.join("; ") || "none"}`);
  const sheet = frame.vertices_coords.length - (fold["misalign:fillers"] ?? []).length;
  const points = await page.evaluate(fold_it, Number(process.env.STEPS ?? 200));
  const ours = distances(frame.vertices_coords.slice(0, sheet)), theirs = distances(points.slice(0, sheet));
  const off = ours.map((x, i) => Math.abs(x - theirs[i]));
  const mean = Math.sqrt(off.reduce((sum, x) => sum + x * x, 0) / off.length);
  console.log(`${basename(file)}: pilot at ${frame["misalign:pilot_deg"]} deg, at most ${Math.max(...off).toFixed(2)} mm, ` +
    `root mean square ${mean.toFixed(2)} mm; complaints: ${problems.join("; ") || "none"}`);
  failures += problems.length > 0;
  await page.close();
}
await browser.close();
server.close();
process.exit(failures ? 1 : 0);
