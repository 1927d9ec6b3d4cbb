// Asks `misalign watch` for the campaign's state every second, and shows it. A page that is opened
// from a file does not ask.
import { by_id, count, plural } from "./format.js";

const kEvery_ms = 1000,
  kPatience_ms = 8000,
  kSlowest_ms = 10000, // longest time between attempts without an answer
  kSpeedOver_s = 20;
const kLost =
  "The program that serves this page does not answer. The page shows the last known state.";

/** Draws per second over the known moments; null for a single one. */
export function recent_speed(moments) {
  const [first, last] = [moments[0], moments.at(-1)];
  return last && last.at_s > first.at_s
    ? Math.max(0, (last.draws - first.draws) / (last.at_s - first.at_s))
    : null;
}

/** [state, words]; `live`: the answer, or null without one. */
export function kind_of(live) {
  if (!live) return ["lost", "no answer: is misalign watch running?"];
  if (live.problem) return ["problem", "catalogue unreadable"];
  if (live.state.complete) return ["complete", "complete"];
  return live.writing ? ["live", "live"] : ["idle", "no search running"];
}

class Watcher {
  #report;
  #show;
  #moments = [];
  #kind = null;
  #timer = 0;
  #wait_ms = kEvery_ms;
  #asking = false;
  #shown_s = null;
  #speed = "";
  #seen_problem = false;

  constructor(report, show) {
    this.#report = report;
    this.#show = show;
    by_id("verb").textContent = "watch";
    by_id("watch").hidden = false;
    by_id("watch-state").textContent = "…";
    by_id("watch-load").addEventListener("click", () => location.reload());
    // A hidden page does not ask.
    document.addEventListener("visibilitychange", () => this.#ask());
    this.#ask();
  }

  async #ask() {
    clearTimeout(this.#timer);
    if (document.hidden || this.#asking) return;
    this.#asking = true;
    try {
      this.#take(await this.#answer());
    } finally {
      this.#asking = false;
      this.#timer = setTimeout(() => this.#ask(), this.#wait_ms);
    }
  }

  async #answer() {
    try {
      const { live } = this.#report.watch;
      const response = await fetch(live, { signal: AbortSignal.timeout(kPatience_ms) });
      return await response.json();
    } catch {
      return null;
    }
  }

  #take(live) {
    this.#wait_ms = live ? kEvery_ms : Math.min(kSlowest_ms, 2 * this.#wait_ms);
    this.#say(...kind_of(live));
    const same = live?.state && live.state.identity === this.#report.campaign?.identity;
    this.#seen_problem ||= Boolean(live?.problem);
    this.#say_more(live, same);
    if (!same) return;
    const speed_changed = this.#measure(live);
    const more = live.total - this.#report.candidates.total;
    this.#offer(more > 0 ? `Load ${plural(more, "new candidate")}` : "");
    if (live.read_at_s === this.#shown_s && !speed_changed) return;
    this.#shown_s = live.read_at_s;
    const { state, faults } = live;
    Object.assign(this.#report, { live, state, faults });
    this.#show(this.#report);
  }

  #say(kind, words) {
    if (kind === this.#kind) return;
    by_id("watch").dataset.kind = kind;
    by_id("watch-state").textContent = words;
    if (this.#kind) by_id("said").textContent = `The campaign: ${words}`;
    this.#kind = kind;
  }

  /** Shows a problem; the page keeps the last known state. */
  #say_more(live, same) {
    const { campaign } = this.#report,
      says = by_id(campaign ? "watch-says" : "broken");
    let words = live?.problem ?? "";
    if (live === null) words = kLost;
    if (live?.state && !same) {
      // A page without a campaign reloads once a fault has passed; else the reader does.
      if (!campaign && this.#seen_problem) return location.reload();
      words = campaign
        ? `This file now holds another campaign, ${live.state.campaign}.`
        : "The catalogue can be read again.";
      this.#offer("Reload");
    }
    says.hidden = words === "";
    if (says.textContent !== words) says.textContent = words;
  }

  /** Measures the speed; returns whether its words have changed. */
  #measure(live) {
    const moments = this.#moments,
      moment = { at_s: live.read_at_s, draws: live.state.draws_in_ledger };
    if (moments.at(-1)?.at_s !== moment.at_s) moments.push(moment);
    while (moments.length > 2 && moment.at_s - moments[1].at_s >= kSpeedOver_s) moments.shift();
    if (!live.writing) moments.splice(0, moments.length - 1);
    const recent = live.writing ? recent_speed(moments) : 0,
      whole = `mean of the run: ${count(Math.round(live.state.draws_per_s))}`;
    live.draws_per_s = recent ?? live.state.draws_per_s;
    live.speed_words = live.writing ? `recent; ${whole}` : `none now; ${whole}`;
    const changed = this.#speed !== live.speed_words;
    this.#speed = live.speed_words;
    return changed;
  }

  /** Offers to reload the page; its address keeps the picked draw. */
  #offer(words) {
    const button = by_id("watch-load");
    button.hidden = words === "";
    if (button.textContent !== words) button.textContent = words;
  }
}

/** Watches the report; calls `show(report)` whenever it has changed. */
export function watch(report, show) {
  if (report.watch) new Watcher(report, show);
}
