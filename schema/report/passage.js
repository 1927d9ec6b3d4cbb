// Animates sampled draws on the chart of first faults: marks move from flat to the pilot angle of
// their first fault. A page that is watched shows those that come in, every page replays its sample.
import { has_angle, marks_of, random_numbers, rows_since } from "./arrivals.js";
import { fault_bins } from "./faults.js";
import { by_id, count, h, plural } from "./format.js";
import { sum, weight } from "./shares.js";
import { fault_colour, fault_name, faults_in } from "./words.js";

const kWhole_ms = 2700, // from flat to 180 degrees
  kArrivals_ms = 900, // starts of the marks of one answer
  kReplay_ms = 12000, // starts of the marks of a replay
  kRest_ms = 1200,
  kFade_ms = 400,
  kMostArrivals = 60,
  kMostReplayed = 240,
  kMostMoving = 180,
  kSeed = 1;
const kRadius_px = 3.2;
const kAbout =
  "A mark moves from flat to the pilot angle of its first fault; a ring marks an accepted draw at the threshold.";
const still = matchMedia("(prefers-reduced-motion: reduce)");

/** "35 sampled draws, which represent 35,840 draws: 34 diagonal reverses, 1 fold limit". */
function words_of(rows) {
  const parts = faults_in(rows.map((row) => row.first_fault)).map(
    (fault) =>
      `${count(sum(rows.filter((row) => row.first_fault === fault)))} ${fault_name(fault)}`,
  );
  const accepted = sum(rows.filter((row) => row.accepted));
  return (
    `${plural(sum(rows), "sampled draw")}, which ${sum(rows) === 1 ? "represents" : "represent"} ${plural(sum(rows, weight), "draw")}: ` +
    `${parts.join(", ")}; accepted: ${count(accepted)}.`
  );
}

/** Lower and upper end of each bar of the stacked histogram, as shares: ends(fault, angle). */
function bar_ends(rows, configuration) {
  const tops = new Map(),
    bars = fault_bins(rows, configuration).map((bin) => {
      const low = tops.get(bin.to) ?? 0;
      tops.set(bin.to, low + bin.share);
      return { ...bin, low, high: low + bin.share };
    });
  return (fault, angle) =>
    bars.find((bar) => bar.first_fault === fault && bar.from < angle && angle <= bar.to);
}

/** The keyframes of a mark that moves from (from_px, y_px) to (to_px, y_px) and rests there. */
function keyframes({ from_px, to_px, y_px, moves_ms, lasts_ms, moving, colour }) {
  const at = (px) => `translate(${px.toFixed(1)}px, ${y_px.toFixed(1)}px)`,
    there = { transform: at(to_px), fill: colour };
  const arrives = moves_ms / lasts_ms;
  return [
    { transform: at(from_px), fill: moving, opacity: 1 },
    { transform: at(to_px), fill: moving, opacity: 1, offset: arrives },
    { ...there, opacity: 1, offset: arrives },
    { ...there, opacity: 1, offset: 1 - kFade_ms / lasts_ms },
    { ...there, opacity: 0 },
  ];
}

class Passage {
  #report;
  #rows; // the sample that was shown last
  #chart = null; // the histogram
  #svg = by_id("passage");
  #paused = false;
  #replays = false;
  #last = ""; // the words about the last arrivals

  constructor(report) {
    this.#report = report;
    this.#rows = report.faults.rows;
    by_id("passage-replay").addEventListener("click", () =>
      this.#replays ? this.#clear() : this.#replay(),
    );
    by_id("passage-pause").addEventListener("click", () => this.#pause(!this.#paused));
    document.addEventListener("visibilitychange", () => this.#run());
    still.addEventListener("change", () => this.#clear());
    this.#label();
  }

  /** Takes a new drawing of the histogram; marks of one with another width are removed. */
  on_chart(chart) {
    this.#chart = chart;
    const view = chart.getAttribute("viewBox");
    if (this.#svg.getAttribute("viewBox") === view) return chart;
    for (const name of ["viewBox", "width", "height"])
      this.#svg.setAttribute(name, chart.getAttribute(name));
    this.#clear();
    return chart;
  }

  /** Shows what has come in since the last call. */
  show(report) {
    this.#report = report;
    const rows = rows_since(this.#rows, report.faults.rows);
    this.#rows = report.faults.rows;
    if (rows.length === 0) return;
    this.#last = `Since the last change: ${words_of(rows)}`;
    const represents =
      this.#replays || this.#is_idle()
        ? 0
        : this.#launch(rows, Math.min(kMostArrivals, this.#free()), kArrivals_ms);
    if (represents) this.#last += ` Each mark: ${plural(Math.round(represents), "draw")}.`;
    if (!this.#replays) this.#label();
  }

  #free = () => Math.max(0, kMostMoving - this.#svg.querySelectorAll(".mark").length);

  /** Returns whether marks would not be seen, or may not move. */
  #is_idle() {
    const { top, bottom } = this.#svg.getBoundingClientRect();
    return (
      !this.#chart ||
      still.matches ||
      this.#paused ||
      document.hidden ||
      bottom < 0 ||
      top > window.innerHeight
    );
  }

  #replay() {
    this.#clear();
    this.#pause(false);
    this.#replays = true;
    const represents = this.#launch(this.#rows, kMostReplayed, kReplay_ms);
    this.#label(
      `Replay in random order with a fixed seed, since the page holds no order of draws. ` +
        `Each mark: ${plural(Math.round(represents), "draw")}. ${kAbout}`,
    );
  }

  /** Starts marks of these rows over a time; returns how many draws each of them represents. */
  #launch(rows, most, over_ms) {
    const random = random_numbers(kSeed),
      { marks, represents } = marks_of(rows, most, random),
      ends = bar_ends(this.#rows, this.#report.campaign.configuration),
      end_ms = over_ms + kWhole_ms + kRest_ms;
    marks.forEach((row, k) => {
      const start_ms = (k / marks.length) * over_ms;
      // Marks of a replay rest until all have arrived.
      const until_ms = this.#replays ? end_ms : null;
      this.#start(row, ends(row.first_fault, row.fault_deg), random(), start_ms, until_ms);
    });
    return represents;
  }

  #start(row, bar, height, start_ms, until_ms) {
    const { path, accept } = this.#report.campaign.configuration,
      x = this.#chart.scale("x").apply,
      y = this.#chart.scale("y"),
      [bottom, top] = y.range;
    // A bar's mark rests within it, that of a draw without a fault anywhere at the end.
    const [low, high] = bar
      ? [bar.low, bar.high].map((share) => y.apply(100 * share))
      : [bottom, top];
    const y_px = Math.min(bottom - kRadius_px, low + (0.1 + 0.8 * height) * (high - low)),
      to_deg = row.fault_deg ?? path.end_deg,
      moves_ms = (to_deg / 180) * kWhole_ms,
      lasts_ms = (until_ms ?? start_ms + moves_ms + kRest_ms) - start_ms;
    const mark = h("svg:circle", { class: "mark", r: kRadius_px, "data-fault": row.first_fault });
    this.#animate(
      mark,
      keyframes({
        ...{ from_px: x(0), to_px: x(to_deg), y_px, moves_ms, lasts_ms },
        moving: "var(--ink)",
        colour: fault_colour(row.first_fault),
      }),
      { delay: start_ms, duration: lasts_ms },
    );
    if (!row.accepted) return;
    const at_deg = Math.min(accept.deploys_from_deg, to_deg),
      place = `translate(${x(at_deg)}px, ${y_px}px)`;
    this.#animate(
      h("svg:circle", { class: "ring", r: kRadius_px }),
      [
        { transform: `${place} scale(1)`, opacity: 1 },
        { transform: `${place} scale(5)`, opacity: 0 },
      ],
      { delay: start_ms + (at_deg / 180) * kWhole_ms, duration: 800, easing: "ease-out" },
    );
  }

  #animate(node, frames, timing) {
    this.#svg.append(node);
    const animation = node.animate(frames, timing);
    animation.onfinish = () => {
      node.remove();
      if (this.#replays && this.#svg.childElementCount === 0) this.#clear();
    };
  }

  #clear() {
    for (const animation of this.#svg.getAnimations({ subtree: true })) animation.cancel();
    this.#svg.replaceChildren();
    this.#replays = false;
    this.#label();
  }

  #pause(paused) {
    this.#paused = paused;
    this.#run();
    this.#label(by_id("passage-words").textContent);
  }

  #run() {
    const runs = !this.#paused && !document.hidden;
    for (const animation of this.#svg.getAnimations({ subtree: true }))
      if (runs) animation.play();
      else animation.pause();
  }

  /** Updates the buttons, and the words. */
  #label(words) {
    const replay = by_id("passage-replay"),
      pause = by_id("passage-pause");
    const watched = Boolean(this.#report.watch);
    this.#svg.parentElement.dataset.replays = this.#replays;
    replay.hidden = still.matches || !this.#rows.some(has_angle);
    replay.textContent = this.#replays ? "■ End replay" : "▶ Replay";
    pause.hidden = still.matches || !(watched || this.#replays);
    pause.textContent = this.#paused ? "▶ Continue" : "❚❚ Pause";
    pause.setAttribute("aria-pressed", String(this.#paused));
    const about = still.matches ? "" : kAbout;
    by_id("passage-words").textContent = words ?? (this.#last || about);
  }
}

let passage = null; // of the page's only histogram

/** Draws the histogram by draw(width) and adds the marks; called again when the report changes. */
export function make_passage(report, draw) {
  passage ??= new Passage(report);
  return {
    draw: (width) => passage.on_chart(draw(width)),
    show: () => passage.show(report),
  };
}
