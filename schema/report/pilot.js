// The slider of the pilot angle: flat on the right, folded on the left, like the charts' axis.
import { first_sample, stop_at } from "./data.js";
import { clamp, degrees, fixed, h } from "./format.js";

const kSweep_s = 7,
  kApart_px = 12, // gap between words of marks
  kKinds = ["flat", "depth", "limit", "used", "contact"]; // of marks: words of later ones are moved

const mark = (place, words, kind, onclick) =>
  h(
    "button",
    {
      type: "button",
      class: `mark ${kind}`,
      style: `--place: ${place.toFixed(4)}`,
      "data-testid": `mark-${kind}`,
      title: `Sheet at: ${words}`,
      onclick,
    },
    h("i"),
    h("b", {}, words),
  );

/** Position of an angle among the samples: 1 at the first, 0 at the last. */
function place_of(angle_deg, angles) {
  const last = angles.length - 1;
  let k = 0;
  while (k < last && angles[k + 1] <= angle_deg) ++k;
  const part = k < last ? (angle_deg - angles[k]) / (angles[k + 1] - angles[k]) : 0;
  return last ? 1 - Math.min(last, k + part) / last : 0.5;
}

class Pilot {
  #state;
  #play = h("button", { type: "button", class: "play", "data-testid": "play" });
  // The pilot angle grows towards the left, where the sheet is folded.
  #slider = h("input", {
    type: "range",
    dir: "rtl",
    min: 0,
    step: 1,
    "aria-label": "Pilot angle",
    "data-testid": "pilot",
  });
  #marks = h("div", { class: "marks" });
  #says = h("output", { "data-testid": "pilot-says" });
  #name = h("a", { href: "#sheet", class: "whose", "data-testid": "pilot-whose" });
  #decoded = null;
  #detail = null;
  #frame = 0;
  #by_itself = null; // what stops a sheet that nobody has started

  constructor(box, state) {
    this.#state = state;
    const track = h("div", { class: "track" }, this.#slider, this.#marks);
    box.append(this.#name, this.#play, track, this.#says);
    this.#listen();
    new ResizeObserver(() => this.#part_words()).observe(this.#marks);
  }

  /** Shows whose metrics are shown, without a folding. */
  name(name) {
    this.#name.textContent = name;
    this.#show_parts(false);
    this.#decoded = null;
  }

  load(detail, decoded, name) {
    this.#name.textContent = name;
    this.#show_parts(true);
    [this.#detail, this.#decoded] = [detail, decoded];
    this.#slider.max = decoded.samples - 1;
    const add = (angle_deg, words, kind) =>
      this.#marks.append(
        mark(place_of(angle_deg, decoded.pilot_deg), words, kind, () => this.#stop_at(angle_deg)),
      );
    const D = detail.verdict.deploys_from_deg,
      limit_deg = detail.fold_limit_deg;
    this.#marks.replaceChildren();
    add(0, "flat", "flat");
    add(D, `D ${degrees(D)}`, "depth");
    if (detail.from_deg && detail.from_deg < D)
      add(detail.from_deg, `used from ${degrees(detail.from_deg)}`, "used");
    if (limit_deg && limit_deg < 180) add(limit_deg, `fold limit ${degrees(limit_deg)}`, "limit");
    const contact_deg = detail.contact?.first_contact?.pilot_deg;
    if (contact_deg) add(contact_deg, `contact ${degrees(contact_deg)}`, "contact");
    this.#part_words();
    this.#label();
    this.move();
  }

  #show_parts(has_folding) {
    for (const part of [this.#play, this.#slider.parentNode, this.#says])
      part.hidden = !has_folding;
  }

  /** Moves words apart: right of those that they overlap, or left of them at the end of the bar. */
  #part_words() {
    const { right } = this.#marks.getBoundingClientRect(),
      frames = [];
    for (const words of kKinds.flatMap((kind) => [...this.#marks.querySelectorAll(`.${kind} b`)])) {
      words.style.removeProperty("left");
      const { left, width } = words.getBoundingClientRect();
      const overlapped = (at) =>
        frames.find((f) => at < f.right + kApart_px && at + width + kApart_px > f.left);
      let at = left,
        frame;
      while ((frame = overlapped(at))) at = frame.right + kApart_px;
      if (at > left && at + width > right) {
        at = left;
        while ((frame = overlapped(at))) at = frame.left - kApart_px - width;
      }
      if (at !== left) words.style.left = `${at - left}px`;
      frames.push(words.getBoundingClientRect());
    }
  }

  move() {
    const k = this.#state.get("sample"),
      pilot_deg = this.#decoded.pilot_deg[k],
      ratio = fixed(this.#decoded.deployment[k], 3),
      beyond = pilot_deg > this.#detail.verdict.deploys_from_deg + 1e-9,
      met = pilot_deg >= this.#detail.contact?.first_contact?.pilot_deg;
    this.#slider.value = k;
    this.#slider.setAttribute("aria-valuetext", `${degrees(pilot_deg)}, deployment ratio ${ratio}`);
    this.#says.replaceChildren(
      h("span", {}, "pilot ", h("strong", { "data-testid": "pilot-deg" }, degrees(pilot_deg))),
      h("span", {}, "D* ", h("strong", {}, ratio)),
      h(
        "span",
        { class: beyond || met ? "warn" : "quiet" },
        beyond ? "beyond D" : met ? "panels in contact" : k === 0 ? "flat" : "up to D",
      ),
    );
  }

  #stop_at(angle_deg) {
    const angles = this.#decoded.pilot_deg,
      next = angles.findIndex((at) => at >= angle_deg - 1e-9);
    stop_at(this.#state, this.#decoded, next < 0 ? angles.length - 1 : next);
  }

  #listen() {
    const state = this.#state,
      slider = this.#slider,
      turn = () => {
        const playing = !state.get("playing");
        this.#by_itself?.disconnect();
        if (!playing) return stop_at(state, this.#decoded, state.get("sample"));
        state.set("playing", true);
        state.set("at", "");
      };
    slider.addEventListener("input", () => {
      stop_at(state, this.#decoded, Number(slider.value));
    });
    this.#play.addEventListener("click", turn);
    document.addEventListener("keydown", (event) => {
      if (event.key !== " " || !this.#decoded) return;
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const at = event.target;
      if (at !== slider && at.closest?.("button, input, select, textarea, summary, a")) return;
      event.preventDefault();
      turn();
    });
    state.on("playing", (playing) => {
      cancelAnimationFrame(this.#frame);
      this.#label();
      if (playing) this.#run();
      else state.set("place", null);
    });
  }

  #label() {
    const playing = this.#state.get("playing");
    this.#play.textContent = playing ? "❚❚ Pause" : "▶ Deploy";
    this.#play.title = playing ? "Pause (space)" : "Unfold the sheet (space)";
    this.#play.setAttribute("aria-pressed", String(Boolean(playing)));
  }

  /** Plays until the sheet has left the screen, unless the reader has stopped it or wants no motion. */
  run_by_itself(sheet) {
    const state = this.#state;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches || state.get("at") !== "") return;
    const watch = new IntersectionObserver(([{ isIntersecting }]) => {
      if (!isIntersecting) state.set("playing", false);
    });
    watch.observe(sheet);
    state.set("playing", true);
    this.#by_itself = watch;
  }

  // Plays the unfolding in a loop, with a rest.
  #run() {
    const now_at = this.#state.get("sample");
    let place = now_at > 0 ? now_at : first_sample(this.#detail, this.#decoded),
      before = performance.now(),
      rest = 0;
    const step = (now) => {
      const passed = clamp((now - before) / 1000, 0, 0.1);
      before = now;
      if (rest > 0) rest -= passed;
      else if (place <= 0) [place, rest] = [first_sample(this.#detail, this.#decoded), 0.4];
      else {
        place = Math.max(0, place - (passed / kSweep_s) * (this.#decoded.samples - 1));
        if (place === 0) rest = 0.9;
      }
      this.#state.set("sample", Math.round(place));
      this.#state.set("place", place);
      this.#frame = requestAnimationFrame(step);
    };
    this.#frame = requestAnimationFrame(step);
  }
}

export const make_pilot = (box, state) => new Pilot(box, state);
