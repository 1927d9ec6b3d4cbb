// Draws the pilot angle of the sheet released at rest over time, and plays the folding at that
// speed.
import * as Plot from "@observablehq/plot";
import { nearest_sample, deployment as ratio_of, time_chart } from "./chart.js";
import { stop_at } from "./data.js";
import { by_id, degrees, h, number } from "./format.js";

const kHeight = 250,
  kSlower = 20;

const kOutcomes = {
  passed_flat: (deployment) =>
    `It passes through flat after ${number(deployment.deploy_time_s)} s, at ${number(Math.abs(deployment.end_deg_per_s))} °/s`,
  flat: (deployment) => `It comes to rest flat after ${number(deployment.deploy_time_s)} s`,
  stalled: () => "It stays at rest: no moment drives it",
  turned_back: () => "It turns back before it is flat",
  fold_limit: () => "It folds to its fold limit",
};

function caption(deployment, report) {
  const friction = deployment.critical_friction_n_mm_per_mm;
  return (
    `From ${degrees(deployment.from_deg)}, ${report.actuators.words}; panels of ${number(deployment.thickness_mm)} mm ` +
    `(total mass ${number(deployment.mass_g)} g), free in space, no friction. ${(kOutcomes[deployment.outcome] ?? (() => deployment.outcome))(deployment)}. ` +
    (friction === null
      ? "It does not reach flat by itself."
      : `Critical friction: ${number(friction)} N mm/mm.`)
  );
}

/** The pilot angle at a time, by linear interpolation between rows. */
function angle_at({ time_s, pilot_deg }, time) {
  if (time_s.length === 1) return pilot_deg[0];
  let k = 1;
  while (k < time_s.length - 1 && time_s[k] < time) ++k;
  const part = Math.min(1, (time - time_s[k - 1]) / (time_s[k] - time_s[k - 1] || 1));
  return pilot_deg[k - 1] + part * (pilot_deg[k] - pilot_deg[k - 1]);
}

/** Plays the motion by the state's sample; stops when anything else moves it, or at the button. */
function make_player(deployment, { state, decoded }, move) {
  let frame = 0,
    playing = false;
  const button = by_id("let-go-play"),
    end_s = deployment.time_s[deployment.time_s.length - 1];
  const label = () => (button.textContent = playing ? "❚❚ Stop" : "▶ Real time");
  const stop = () => {
    cancelAnimationFrame(frame);
    playing = false;
    label();
  };
  const rest = () => {
    stop();
    stop_at(state, decoded, state.get("sample"));
  };
  const start = () => {
    const slower = by_id("let-go-slowly").checked ? kSlower : 1,
      begun = performance.now();
    state.set("playing", false);
    state.set("at", "");
    playing = true;
    label();
    let ours = null;
    const step = (now) => {
      if (ours !== null && (state.get("sample") !== ours || state.get("playing"))) return stop();
      const time = Math.min(end_s, Math.max(0, (now - begun) / 1000 / slower));
      ours = nearest_sample(decoded, ratio_of(Math.abs(angle_at(deployment, time))));
      state.set("sample", ours);
      move(time);
      if (time >= end_s) return rest();
      frame = requestAnimationFrame(step);
    };
    frame = requestAnimationFrame(step);
  };
  button.onclick = () => (playing ? rest() : start());
  label();
  return stop;
}

let stop_last = () => {};

/** The chart of the motion, or null where the report has none. */
export function make_deployment(report, folding) {
  const { detail, decoded } = folding,
    deployment = decoded.motion;
  stop_last();
  by_id("let-go-card").hidden = !deployment;
  if (!deployment) return null;
  by_id("let-go-caption").textContent = caption(detail.let_go, report);
  let dot = null,
    x = null,
    y = null,
    shown_s = 0;
  const move = (time) => {
    shown_s = time;
    if (!dot) return;
    dot.setAttribute("cx", x.apply(time));
    dot.setAttribute("cy", y.apply(angle_at(deployment, time)));
  };
  const points = Array.from(deployment.time_s, (time, k) => [time, deployment.pilot_deg[k]]);
  const draw = (width) => {
    const plot = time_chart(width, {
      height: kHeight,
      label: "pilot angle against time",
      y: { label: "pilot angle (°)" },
      end_s: deployment.time_s.at(-1),
      marks: [Plot.line(points, { stroke: "var(--accent)", strokeWidth: 2 })],
    });
    x = plot.scale("x");
    y = plot.scale("y");
    dot = h("svg:circle", { class: "value-dot", r: 4, "data-testid": "let-go-dot" });
    plot.append(dot);
    move(shown_s);
    return plot;
  };
  stop_last = make_player(deployment, folding, move);
  return { draw };
}
