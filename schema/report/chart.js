// Charts that fill their box and are drawn again when its width changes. Charts over the pilot
// angle share an axis, and a rule that moves with the slider.
import * as Plot from "@observablehq/plot";
import { stop_at } from "./data.js";
import { degrees, h } from "./format.js";
import { on_print, paper_share } from "./paper.js";
import { text_width } from "./text_size.js";

const kLetter_px = 12, // of .plot in page.css
  kTick_px = 12,
  kTitle_px = 20,
  kLeft_px = 66,
  kRight_px = 14,
  kBeside_px = 22; // width of a rotated word

/**
 * Calls draw(width) when the box's width changes, also on paper; returns a function that redraws.
 */
export function when_wide(box, draw) {
  let width = Math.floor(box.clientWidth),
    share = null; // of that width, on paper
  const redraw = () => {
    if (width > 0) draw(Math.floor(width * (share ?? 1)));
  };
  new ResizeObserver(([entry]) => {
    const now = Math.floor(entry.contentRect.width);
    if (now === width || now === 0 || share) return;
    width = now;
    redraw();
  }).observe(box);
  on_print((printing) => {
    share = printing ? paper_share() : null;
    redraw();
  });
  redraw();
  return redraw;
}

const charts = new WeakMap(); // by box

/**
 * Shows draw(width) in the box instead of its earlier chart, now or once no pointer is over that
 * ("left"); returns a function that redraws.
 */
export function show_when_wide(box, draw, when = "left") {
  const chart = charts.get(box);
  if (chart) {
    chart.draw = draw;
    if (when === "now" || !box.matches(":hover")) chart.redraw();
    else box.addEventListener("pointerleave", chart.redraw, { once: true });
    return chart.redraw;
  }
  const made = { draw, redraw: null };
  charts.set(box, made);
  made.redraw = when_wide(box, (width) => box.replaceChildren(made.draw(width)));
  return made.redraw;
}

/** Text that stands off the lines behind it. */
export const kHalo = { fill: "var(--ink)", stroke: "var(--card)", strokeWidth: 4 };

const kAxis_x = { labelAnchor: "center", labelArrow: "none" };

/**
 * Plot.plot in the page's style. Its labelled parts have a role: without one they may have no
 * label.
 */
export function plot_of({ x, y, ...options }) {
  const plot = Plot.plot({
    className: "plot",
    ...options,
    x: { ...kAxis_x, ...x },
    y: { labelArrow: "none", ...y },
  });
  for (const part of plot.querySelectorAll("[aria-label]:not([role])"))
    part.setAttribute("role", part.localName === "g" ? "group" : "img");
  return plot;
}

/** plot_of with room on the left for the widest tick, and for a title along the axis. */
export function plot_with_room(options) {
  const plot = plot_of(options);
  const ticks = plot.querySelectorAll('g[aria-label^="y-axis tick label"] text');
  const widest = Math.max(0, ...[...ticks].map((tick) => text_width(tick.textContent, kLetter_px)));
  const along = options.y?.labelAnchor === "center" ? kTitle_px : 0;
  const room = Math.ceil(widest) + kTick_px + along;
  return room > options.marginLeft ? plot_of({ ...options, marginLeft: room }) : plot;
}

/** plot_with_room for a logarithmic scale: its uppermost tick is at the very top. */
export const log_chart = (options) =>
  plot_with_room({
    ...{ marginTop: 30, marginLeft: 62, marginBottom: 42 },
    ...options,
    y: { type: "log", grid: true, ...options.y },
  });

/** A chart over the time, from 0 to `end_s`. */
export const time_chart = (width, { label, y, end_s, marks, ...options }) =>
  plot_with_room({
    ...{ width, height: 260, marginTop: 28, marginLeft: kLeft_px, marginRight: kRight_px },
    ...{ marginBottom: 40, ariaLabel: label, ...options },
    x: { label: "time (s)", grid: true, domain: [0, end_s] },
    y: { grid: true, nice: true, ...y },
    marks: [Plot.ruleY([0], { stroke: "var(--ink-soft)" }), ...marks],
  });

const kPilotTicks_deg = [0, 30, 60, 90, 120, 150, 180],
  kRatioTicks = Array.from({ length: 11 }, (_, i) => i / 10),
  kNarrow_px = 460; // where the axes' titles are shorter
export const deployment = (pilot_deg) => (180 - pilot_deg) / 180;

const band = (from_deg, to_deg, fill) =>
  Plot.rectX([0], { x1: deployment(from_deg), x2: deployment(to_deg), fill });

function word(angle_deg, words, line) {
  const at = deployment(angle_deg),
    left = at > 0.75;
  return Plot.text([words], {
    x: () => at,
    frameAnchor: "top",
    dy: 4 + 14 * line,
    dx: left ? -5 : 5,
    textAnchor: left ? "end" : "start",
    ...kHalo,
  });
}

const rule_at = (angle_deg, style) => Plot.ruleX([deployment(angle_deg)], style);

const contact_marks = (angle_deg, line) => [
  rule_at(angle_deg, { stroke: "var(--contact)", strokeDasharray: "4 3", strokeWidth: 1.5 }),
  word(angle_deg, `contact ${degrees(angle_deg)}`, line),
];

/** Words along the left edge of the band beyond the fold limit, where they hide no line. */
const word_beyond = (words, edge) =>
  Plot.text([words], {
    x: () => edge,
    frameAnchor: "middle",
    dx: 11,
    rotate: -90,
    textAnchor: "middle",
    ...kHalo,
    stroke: "var(--nothing)",
  });

/**
 * Marks of D, the fold limit, the stroke limit and the contact, and bands beyond D and the fold
 * limit. `room` is free left of the last sample; a word beside it needs `letter` more, as shares of
 * the axis.
 */
function limit_marks(detail, end_deg, room, letter) {
  const D = detail.verdict.deploys_from_deg,
    limit_deg = detail.fold_limit_deg,
    over_deg = detail.over_stroke?.from_deg,
    contact_deg = detail.contact?.first_contact?.pilot_deg,
    last_deg = Math.min(limit_deg ?? end_deg, end_deg),
    limited = limit_deg && limit_deg < end_deg,
    aside = limited && deployment(limit_deg) - deployment(end_deg) >= letter,
    limit_words = limited ? `fold limit ${degrees(limit_deg)}` : "";
  return {
    // There is no state beyond the fold limit; between D and it the sheet folds, with a fault.
    below: [
      limited ? band(end_deg + 180 * room, last_deg, "var(--nothing)") : null,
      D < last_deg ? band(last_deg, D, "var(--beyond)") : null,
    ],
    above: [
      rule_at(D, { stroke: "var(--ink)", strokeDasharray: "2 3" }),
      word(D, `D = ${degrees(D)}`, 0),
      limited ? rule_at(limit_deg, { stroke: "var(--mountain)", strokeDasharray: "6 2" }) : null,
      limited && !aside ? word(limit_deg, limit_words, 1) : null,
      aside ? word_beyond(limit_words, deployment(end_deg) - room) : null,
      over_deg
        ? rule_at(over_deg, {
            stroke: "var(--over-folded)",
            strokeDasharray: "1 3",
            strokeWidth: 1.5,
          })
        : null,
      over_deg ? word(over_deg, `stroke limit ${degrees(over_deg)}`, aside ? 1 : 2) : null,
      ...(contact_deg <= last_deg
        ? contact_marks(contact_deg, (aside ? 1 : 2) + (over_deg ? 1 : 0))
        : []),
    ],
  };
}

const folding_axes = (end_deg, is_narrow) => [
  Plot.axisX(
    kRatioTicks.filter((ratio, i) => ratio >= deployment(end_deg) && !(is_narrow && i % 2)),
    {
      label: is_narrow
        ? "deployment ratio D* (0 folded, 1 flat)"
        : "deployment ratio D* = (180° − pilot angle)/180°   (0 folded, 1 flat)",
      ...kAxis_x,
      tickFormat: (ratio) => ratio.toFixed(1),
    },
  ),
  Plot.axisX(kPilotTicks_deg.filter((deg) => deg <= end_deg).map(deployment), {
    anchor: "top",
    ...kAxis_x,
    label: is_narrow ? null : "pilot angle", // beside the values at the slider's angle
    labelOffset: 34,
    tickFormat: (share) => degrees(Math.round(180 * (1 - share))),
  }),
];

/** The sample whose deployment ratio is nearest. */
export function nearest_sample(decoded, ratio) {
  let best = 0;
  decoded.deployment.forEach((value, k) => {
    if (Math.abs(value - ratio) < Math.abs(decoded.deployment[best] - ratio)) best = k;
  });
  return best;
}

/** A press on the chart moves the slider there. */
function seek_on(plot, width, x, state, decoded) {
  const seek = (event) => {
    const frame = plot.getBoundingClientRect(),
      ratio = x.invert(((event.clientX - frame.left) * width) / frame.width);
    stop_at(state, decoded, nearest_sample(decoded, ratio));
  };
  plot.addEventListener("pointerdown", (event) => {
    plot.setPointerCapture(event.pointerId);
    seek(event);
  });
  plot.addEventListener("pointermove", (event) => event.buttons & 1 && seek(event));
}

/**
 * A chart over the deployment ratio with the pilot angle above, D and the fold limit marked.
 * `lines(svg, x, y)` adds its lines; the rule follows the state's sample, and a press on the chart
 * moves the sample there.
 */
export function folding_chart({
  state,
  detail,
  decoded,
  end_deg,
  height,
  y,
  label,
  lines,
  marks = [],
  room_px = 0,
}) {
  let rule = null,
    x = null;
  const move = () => {
    if (!rule) return;
    const at = x.apply(decoded.deployment[state.get("sample")]);
    rule.setAttribute("x1", at);
    rule.setAttribute("x2", at);
  };
  const draw = (width) => {
    // Room left of the last sample, as a share of the axis.
    const px = (1 - deployment(end_deg)) / (width - kLeft_px - kRight_px - room_px),
      room = room_px * px;
    const limits = limit_marks(detail, end_deg, room, kBeside_px * px);
    const plot = plot_with_room({
      width,
      height,
      marginLeft: kLeft_px,
      marginRight: kRight_px,
      marginTop: 38,
      marginBottom: 40,
      ariaLabel: label,
      x: { domain: [deployment(end_deg) - room, 1], label: null },
      y: { grid: true, ...y },
      marks: [
        ...limits.below,
        ...folding_axes(end_deg, width < kNarrow_px),
        ...marks,
        ...limits.above,
      ],
    });
    x = plot.scale("x");
    lines(plot, x, plot.scale("y"));
    for (const words of plot.querySelectorAll('g[aria-label="text"]')) plot.append(words);
    rule = h("svg:line", { class: "now", y1: 38, y2: height - 40, "data-testid": "rule" });
    plot.append(rule);
    move();
    seek_on(plot, width, x, state, decoded);
    return plot;
  };
  return { draw, move };
}

/** A path through (x, y) of the samples; samples without a value interrupt it. */
export function path_of(samples, point) {
  let path = "",
    pen_down = false;
  for (const k of samples) {
    const [px, py] = point(k);
    if (!Number.isFinite(py)) {
      pen_down = false;
      continue;
    }
    path += `${pen_down ? "L" : "M"}${px.toFixed(2)},${py.toFixed(2)}`;
    pen_down = true;
  }
  return path;
}

export const range = (from, to) =>
  Array.from({ length: Math.max(0, to - from + 1) }, (_, i) => from + i);
