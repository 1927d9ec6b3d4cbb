// Twenty tasks of strangers on the site of the manual: each page that answers is at most two clicks from the first one,
// or among the first results of one search. Thirty queries in the field's words: the right page is among the first three.
// Cards, moving drawing and width of pages: site_looks.mjs.
// site_test.mjs FOLDER
import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { kPatience_ms, open_browser } from "./browser.mjs";
import { check_looks, watch_page } from "./site_looks.mjs";

const kFirstResults = 5,
  kFirstOfQuery = 3;

// Wishes; words typed into the search box; the pages that answer; what must be said there.
const kTasks = [
  [
    "cut my own 60 × 90 mm sheet",
    "cut panels 60 90",
    ["how-to/cut-my-own-sheet", "tutorials/from-sizes-to-a-drawing"],
    /--kit/,
  ],
  [
    "what is a pilot crease",
    "pilot crease",
    ["explanation/method", "reference/words"],
    /crease whose fold angle/,
  ],
  ["run on Slurm", "slurm", ["how-to/slurm"], /sbatch/],
  ["install without root", "without root", ["how-to/without-root"], /\.local/],
  ["which amplitude", "which amplitude", ["how-to/amplitude"], /amplitude_mm/],
  ["load in MATLAB", "matlab", ["how-to/matlab"], /--format mat/],
  [
    "resume after a kill",
    "resume after kill",
    ["how-to/resume", "reference/interruptions"],
    /same command/,
  ],
  ["merge two machines", "merge machines", ["how-to/merge"], /misalign merge/],
  [
    "what does a fault mean",
    "fault",
    ["reference/faults", "how-to/why-it-fails", "explanation/verdicts"],
    /not_monotone/,
  ],
  [
    "add a pattern of my own",
    "own pattern",
    ["how-to/own-mesh", "code/search/patterns/index"],
    /FOLD/,
  ],
  ["stop half open", "stop half open", ["how-to/stop-half-open"], /stops_at_deg/],
  [
    "springs and wires",
    "springs wires",
    ["how-to/springs-and-wires", "explanation/deployment"],
    /--stroke-limit/,
  ],
  [
    "how thick may panels be",
    "how thick panels",
    ["how-to/thickness", "explanation/building"],
    /misalign contact/,
  ],
  [
    "cut a little off",
    "cut a little off",
    ["how-to/cut-a-little-off", "explanation/building"],
    /misalign tolerance|tolerance/,
  ],
  ["play in joints", "joints play", ["how-to/play", "explanation/building"], /--backlash/],
  [
    "what is certified",
    "certified",
    ["explanation/certificates", "how-to/certificate"],
    /certified angle|certified_deg/,
  ],
  [
    "a rarer sheet",
    "rarer sheet",
    ["how-to/rare", "explanation/rare-sheets", "tutorials/rare-sheets"],
    /splitting/,
  ],
  ["SQL over candidates", "SQL candidates", ["how-to/sql", "code/schema/queries/index"], /SELECT/],
  ["figures from Python", "figures python", ["how-to/python-figures", "gallery/index"], /Python/],
  ["cite it", "cite", ["how-to/cite", "overview"], /10\.1098\/rspa\.2015\.0235/],
];

// Words of an engineer who never saw the program; the right pages.
const kQueries = [
  ["Pareto", ["how-to/choose", "how-to/optimise"]],
  ["static margin", ["how-to/hinges", "how-to/card", "explanation/deployment"]],
  ["tolerance analysis", ["how-to/cut-a-little-off"]],
  ["snap-through", ["explanation/deployment", "how-to/hinges", "how-to/elastic"]],
  ["buckling", ["explanation/deployment", "how-to/elastic"]],
  ["bistable", ["how-to/stop-half-open"]],
  ["compliant hinge", ["how-to/hinges"]],
  ["restart file", ["how-to/resume"]],
  ["checkpoint", ["how-to/resume", "reference/interruptions"]],
  ["MPI array job", ["how-to/slurm", "how-to/schedulers"]],
  ["random seed", ["explanation/method", "how-to/merge", "tutorials/campaign"]],
  ["reproducibility", ["explanation/checks", "explanation/method", "reference/interruptions"]],
  ["confidence interval", ["explanation/rare-sheets", "tutorials/campaign"]],
  ["rare event", ["explanation/rare-sheets", "how-to/rare", "tutorials/rare-sheets"]],
  ["mesh import", ["how-to/own-mesh"]],
  ["laser kerf", ["how-to/cut-a-kit", "reference/kit"]],
  ["bill of materials", ["how-to/cut-a-kit", "reference/kit"]],
  ["spring stiffness", ["how-to/springs-and-wires"]],
  ["shape memory alloy", ["how-to/springs-and-wires"]],
  ["degrees of freedom", ["explanation/method"]],
  ["finite element", ["how-to/elastic", "explanation/deployment"]],
  ["damping", ["tutorials/let-it-go", "explanation/deployment", "how-to/hinges"]],
  ["panel thickness", ["how-to/thickness"]],
  ["hinge clearance", ["how-to/play"]],
  ["objective function", ["how-to/optimise"]],
  ["interval arithmetic", ["explanation/certificates", "how-to/certificate"]],
  ["Newton continuation", ["explanation/method"]],
  ["CSV export", ["reference/formats", "how-to/other-tools"]],
  ["HPC cluster", ["how-to/slurm", "how-to/schedulers", "how-to/across-hosts"]],
  ["database query", ["how-to/sql"]],
];

const site = resolve(process.argv[2]);
const address = (name) => pathToFileURL(`${site}/${name}.html`).href;
const without_anchor = (href) => href.split("#")[0];

const browser = await open_browser();
const context = await browser.newContext({ viewport: { width: 1300, height: 900 }, offline: true });
const page = await context.newPage();
page.setDefaultTimeout(kPatience_ms);
const problems = [];
watch_page(page, problems);

/** The pages that visible links of the open page lead to. */
const links = async () => {
  const all = await page.locator("a:visible").evaluateAll((each) => each.map(({ href }) => href));
  return new Set(all.map(without_anchor));
};

await page.goto(address("index"));
const one_click = await links();
const two_clicks = new Map();
for (const href of one_click) {
  if (!href.startsWith("file:") || !href.endsWith(".html")) continue;
  await page.goto(href);
  two_clicks.set(href, await links());
}

/** The first of these pages among the results of a search: 1, 2, ...; 0 if none is. */
const rank_of = async (typed, wanted) => {
  await page.goto(address("index"));
  await page.fill(".sidebar-search", typed);
  await page.press(".sidebar-search", "Enter");
  await page.waitForFunction(() =>
    /found|did not match/.test(document.querySelector(".search-summary")?.textContent),
  );
  const results = await page
    .locator("ul.search li a")
    .evaluateAll((each) => each.map(({ href }) => href.split("#")[0].split("?")[0]));
  return results.findIndex((href) => wanted.includes(href)) + 1;
};

for (const [typed, answers] of kQueries) {
  const rank = await rank_of(typed, answers.map(address));
  console.log(`"${typed}": ${rank || "-"}`);
  if (!(rank >= 1 && rank <= kFirstOfQuery))
    problems.push(`"${typed}": ${answers[0]} is not among the first`);
}

for (const [task, typed, answers, said] of kTasks) {
  const wanted = answers.map(address);
  let clicks = "-";
  if (wanted.some((href) => one_click.has(href))) clicks = 1;
  else if ([...two_clicks.values()].some((next) => wanted.some((href) => next.has(href))))
    clicks = 2;

  const rank = await rank_of(typed, wanted);

  const exists = [];
  for (const href of wanted.filter((each) => existsSync(new URL(each)))) {
    await page.goto(href);
    if (said.test(await page.locator("article").innerText())) exists.push(href);
  }
  console.log(`${task}: ${clicks} clicks; "${typed}": ${rank || "-"}`);
  if (exists.length === 0) problems.push(`${task}: no page says ${said}`);
  if (clicks === "-" && !(rank >= 1 && rank <= kFirstResults)) problems.push(`${task}: not found`);
}
await check_looks(browser, site, problems);
await browser.close();
for (const problem of problems) console.log(`FAILED: ${problem}`);
process.exit(problems.length ? 1 : 0);
