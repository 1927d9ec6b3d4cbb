// Charts the share of draws that deploy from each level of a splitting search.
import * as Plot from "@observablehq/plot";
import { log_chart } from "./chart.js";
import { clamp, count, degrees, number, plural, power, powers } from "./format.js";

const kMostTicks = 9,
  kRow_px = 28, // of the table beside it, about as high
  kHeight_px = [320, 560];

/** Decades round all points, and at most kMostTicks ticks at them. */
function decades(points) {
  const values = points.flatMap(({ share, low, high }) => [share, low, high]).filter((x) => x > 0);
  const first = Math.floor(Math.log10(Math.min(...values, 0.1)) + 1e-9),
    last = Math.min(0, Math.ceil(Math.log10(Math.max(...values, 0.1)) - 1e-9));
  const domain = [10 ** first, 10 ** Math.max(last, first + 1)];
  const all = powers(...domain),
    step = Math.ceil(all.length / kMostTicks);
  return { domain, ticks: all.filter((_, k) => (all.length - 1 - k) % step === 0) };
}

// Bars wider than the points: an interval may be shorter than a point.
const interval_mark = (points, least) =>
  Plot.ruleX(
    points.filter(({ low }) => low !== null),
    {
      x: "from_deg",
      y1: ({ low }) => Math.max(low, least),
      y2: "high",
      stroke: "var(--accent)",
      strokeOpacity: 0.4,
      strokeWidth: 9,
    },
  );

const interval_words = ({ low, high }) =>
  low === null ? "" : ` (95 %: ${number(low)} – ${number(high)})`;

const tip = (points, populations) =>
  Plot.tip(
    points,
    Plot.pointerX({
      x: "from_deg",
      y: "share",
      title: (point) =>
        `level ${point.level}, from ${degrees(point.from_deg)}\n` +
        `${number(point.share)} of draws${interval_words(point)}\n` +
        `${count(point.reached)} of ${plural(populations, "population")} reached it`,
    }),
  );

/** Description of the chart for screen readers. */
function description(points) {
  const words = (point) =>
    `${number(point.share)} of draws deploy from ${degrees(point.from_deg)}${interval_words(point)}`;
  const [first, last] = [points[0], points.at(-1)];
  return `${words(first)}${last === first ? "" : `, ${words(last)}`}. The table of levels has all numbers.`;
}

/**
 * `points`: the levels that were reached, { level, from_deg, share, low, high, reached };
 * `least_deg`, `most_deg`: the angles of the first and the last level, reached or not.
 */
export function ladder_chart(points, [least_deg, most_deg], populations, width) {
  const { domain, ticks } = decades(points),
    spare_deg = 0.06 * (most_deg - least_deg) || 1;
  return log_chart({
    width,
    height: clamp(kRow_px * (points.length + 2), ...kHeight_px),
    ariaLabel: "Share of draws that deploy from each level",
    ariaDescription: description(points),
    x: {
      label: "level: deploys from (°)",
      domain: [least_deg - spare_deg, most_deg + spare_deg],
    },
    y: {
      label: "share of draws (log scale)",
      domain,
      ticks,
      tickFormat: power,
    },
    marks: [
      Plot.lineY(points, {
        x: "from_deg",
        y: "share",
        stroke: "var(--accent)",
        strokeOpacity: 0.5,
        strokeWidth: 1.5,
      }),
      interval_mark(points, domain[0]),
      Plot.dot(points, { x: "from_deg", y: "share", fill: "var(--accent)", r: 3 }),
      tip(points, populations),
    ],
  });
}
