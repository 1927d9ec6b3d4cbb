// The slider over the pilot angle: flat on the right, folded on the left, as the charts' axis.
import { degrees, fixed, h } from "./format.js";

const kSweep_s = 7;

export function make_pilot(box, state) {
  const play = h("button", { type: "button", class: "play", "data-testid": "play" });
  // Right to left: the pilot angle grows towards the left, where the sheet is folded.
  const slider = h("input", {
    type: "range",
    dir: "rtl",
    min: 0,
    step: 1,
    "aria-label": "Pilot fold angle",
    "data-testid": "pilot",
  });
  const marks = h("div", { class: "marks" }),
    says = h("output", { "data-testid": "pilot-says" });
  box.append(play, h("div", { class: "track" }, slider, marks), says);
  let decoded = null,
    detail = null;

  slider.addEventListener("input", () => {
    state.set("playing", false);
    state.set("sample", Number(slider.value));
  });
  play.addEventListener("click", () => state.set("playing", !state.get("playing")));
  document.addEventListener("keydown", (event) => {
    if (event.key !== " " || !decoded || event.ctrlKey || event.metaKey || event.altKey) return;
    const at = event.target;
    if (at !== slider && at.closest?.("button, input, select, textarea, summary, a")) return;
    event.preventDefault();
    state.set("playing", !state.get("playing"));
  });

  // Unfolds, rests, and starts again from where the sheet deploys from; what was not accepted is
  // shown from where its path ends.
  const start = () => (detail.accepted && decoded.depth > 0 ? decoded.depth : decoded.samples - 1);
  let frame = 0;
  state.on("playing", (playing) => {
    cancelAnimationFrame(frame);
    label();
    if (!playing) return;
    let place = state.get("sample") > 0 ? state.get("sample") : start(),
      before = performance.now(),
      rest = 0;
    const step = (now) => {
      const passed = Math.min(0.1, (now - before) / 1000);
      before = now;
      if (rest > 0) rest -= passed;
      else if (place <= 0) [place, rest] = [start(), 0.4];
      else {
        place = Math.max(0, place - (passed / kSweep_s) * (decoded.samples - 1));
        if (place === 0) rest = 0.9;
      }
      state.set("sample", Math.round(place));
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  });

  function label() {
    const playing = state.get("playing");
    play.textContent = playing ? "❚❚ Pause" : "▶ Deploy";
    play.title = playing ? "Pause (space)" : "Unfold the sheet (space)";
    play.setAttribute("aria-pressed", String(Boolean(playing)));
  }

  function place_of(angle_deg) {
    const angles = decoded.pilot_deg,
      last = angles.length - 1;
    let k = 0;
    while (k < last && angles[k + 1] <= angle_deg) ++k;
    const part = k < last ? (angle_deg - angles[k]) / (angles[k + 1] - angles[k]) : 0;
    return last ? 1 - Math.min(last, k + part) / last : 0.5;
  }

  return {
    load(detail_, decoded_) {
      [detail, decoded] = [detail_, decoded_];
      slider.max = decoded.samples - 1;
      const mark = (angle_deg, words, kind) =>
        h(
          "span",
          {
            class: `mark ${kind}`,
            style: `--place: ${place_of(angle_deg).toFixed(4)}`,
            "data-testid": `mark-${kind}`,
            title: words,
          },
          h("i"),
          h("b", {}, words),
        );
      const D = detail.verdict.deploys_from_deg,
        limit_deg = detail.fold_limit_deg;
      marks.replaceChildren(mark(0, "flat", "flat"), mark(D, `D ${degrees(D)}`, "depth"));
      if (limit_deg && limit_deg < 180)
        marks.append(mark(limit_deg, `fold limit ${degrees(limit_deg)}`, "limit"));
      label();
      this.move();
    },
    move() {
      const k = state.get("sample"),
        pilot_deg = decoded.pilot_deg[k],
        D = detail.verdict.deploys_from_deg;
      slider.value = k;
      slider.setAttribute(
        "aria-valuetext",
        `${degrees(pilot_deg)}, deployment ratio ${fixed(decoded.deployment[k], 3)}`,
      );
      says.replaceChildren(
        h("span", {}, "pilot ", h("strong", { "data-testid": "pilot-deg" }, degrees(pilot_deg))),
        h("span", {}, "D* ", h("strong", {}, fixed(decoded.deployment[k], 3))),
        h(
          "span",
          { class: pilot_deg > D + 1e-9 ? "warn" : "quiet" },
          pilot_deg > D + 1e-9 ? "beyond D" : k === 0 ? "flat" : "deploys from here",
        ),
      );
    },
  };
}
