// Charts the pilot angles of the first faults of the fault sample.
import * as Plot from "@observablehq/plot";
import { log_chart, plot_with_room } from "./chart.js";
import { count, degrees, percent, plural, powers } from "./format.js";
import { effective, sum, survival_points, weight } from "./shares.js";
import { fault_colour, fault_name, fault_order, faults_in } from "./words.js";

/** Histogram of the first faults by pilot angle: a bin holds (from, to]. */
export function fault_bins(rows, { path }) {
  const bin_deg = Math.max(5, path.sample_deg);
  const bins = new Map(),
    all = sum(rows, weight);
  for (const row of rows) {
    const { first_fault, fault_deg, sampled } = row;
    if (fault_deg === null || first_fault === "none") continue;
    // A fault at 170° is in the bin that ends there.
    const to = Math.ceil(fault_deg / bin_deg) * bin_deg,
      key = `${first_fault} ${to}`;
    if (!bins.has(key))
      bins.set(key, { first_fault, from: to - bin_deg, to, sampled: 0, share: 0 });
    bins.get(key).sampled += sampled;
    bins.get(key).share += weight(row) / all;
  }
  const place = ({ first_fault }) => fault_order.indexOf(first_fault);
  return [...bins.values()].sort((a, b) => place(a) - place(b) || a.to - b.to);
}

const threshold_marks = (deg, words, colour = "var(--ink)") => [
  Plot.ruleX([deg], { stroke: colour, strokeDasharray: "2 3" }),
  words
    ? Plot.text([deg], {
        x: (d) => d,
        frameAnchor: "top",
        text: () => words,
        textAnchor: "end",
        dx: -5,
        fill: "var(--ink)",
      })
    : null,
];

/** `most`: the end of the scale of shares, where several charts have one. */
export function faults_chart(rows, total, { path, accept }, width, most) {
  const bins = fault_bins(rows, { path }),
    present = faults_in(bins.map((bin) => bin.first_fault));
  return plot_with_room({
    width,
    height: 280,
    marginLeft: 52,
    marginBottom: 42,
    ariaLabel: "First faults by pilot angle, stacked by kind",
    x: {
      label: "pilot angle of the first fault (°)",
      domain: [0, path.end_deg],
    },
    y: {
      ...{ label: "sampled draws (%)", grid: true, percent: true },
      ...(most ? { domain: [0, 100 * most] } : {}),
    },
    color: { domain: present, range: present.map(fault_colour) },
    marks: [
      Plot.rectY(
        bins,
        Plot.stackY({
          x1: "from",
          x2: "to",
          y: "share",
          fill: "first_fault",
          insetLeft: 0.5,
          insetRight: 0.5,
          order: present,
          title: (bin) =>
            `${fault_name(bin.first_fault)}\nabove ${bin.from}° up to ${bin.to}°\n${count(bin.sampled)} of ${plural(total, "sampled draw")} (${percent(bin.share)})`,
          tip: true,
        }),
      ),
      ...threshold_marks(accept.deploys_from_deg, "threshold"),
      Plot.ruleY([0]),
    ],
  });
}

/** The acceptance rate of all draws, with its interval. */
const overall_marks = (overall, colour) => [
  Plot.ruleX(overall, {
    x: "angle",
    y1: "low",
    y2: "high",
    stroke: colour,
    strokeWidth: 1.5,
  }),
  Plot.dot(overall, {
    x: "angle",
    y: "rate",
    fill: colour,
    r: 4,
    title: (d) => `all draws: ${percent(d.rate)} accepted`,
  }),
];

const survival_band = ({ points, colour }, least) =>
  Plot.areaY(points, {
    x: "angle",
    y1: (point) => Math.max(point.low, 0.4 * least),
    y2: "high",
    curve: "step-after",
    fill: colour,
    fillOpacity: 0.18,
  });

/** A line up to the angle at which no draw is left, where a log scale has no place. */
function survival_line({ points, colour }) {
  const end = points.findIndex(({ left }) => left === 0);
  const shown =
    end > 0
      ? [...points.slice(0, end), { ...points[end - 1], angle: points[end].angle }]
      : points.filter(({ left }) => left > 0);
  return Plot.lineY(shown, {
    ...{ x: "angle", y: "share", curve: "step-after" },
    ...{ stroke: colour, strokeWidth: 2 },
  });
}

const survival_tip = (samples) =>
  Plot.tip(
    samples.flatMap(({ points, total, name }) =>
      points.map((point) => ({ ...point, total, name })),
    ),
    (samples.length > 1 ? Plot.pointer : Plot.pointerX)({
      x: "angle",
      y: "share",
      title: (d) =>
        `${samples.length > 1 ? `${d.name}, ` : ""}${degrees(d.angle)}: ${percent(d.share)} without a fault\n${count(d.left)} of ${plural(d.total, "sampled draw")}`,
    }),
  );

/** A campaign's survival by pilot angle, for survival_chart. */
export function survival_of({ campaign, state, faults }) {
  const { path, accept } = campaign.configuration,
    { rate, rate_low, rate_high } = state.acceptance ?? {};
  return {
    name: campaign.name,
    points: survival_points(faults.rows, campaign.configuration),
    total: sum(faults.rows),
    threshold_deg: accept.deploys_from_deg,
    end_deg: path.end_deg,
    overall:
      rate > 0 ? [{ angle: accept.deploys_from_deg, rate, low: rate_low, high: rate_high }] : [],
    least: Math.min(0.5 / effective(faults.rows), rate > 0 ? rate_low || 1 : 1),
    colour: "var(--accent)",
    colour_of_marks: "var(--ink)",
  };
}

export function survival_chart(samples, width) {
  const least = Math.min(...samples.map((sample) => sample.least));
  return log_chart({
    ...{ width, height: 280 },
    ariaLabel: "Survival by pilot angle",
    x: {
      label: "pilot angle (°)",
      domain: [0, Math.max(...samples.map(({ end_deg }) => end_deg))],
    },
    y: {
      label: "share without a fault (%, log scale)",
      domain: [least, 1],
      clamp: true,
      ticks: powers(least, 1),
      tickFormat: (share) => percent(share, 1),
    },
    marks: [
      ...samples.map((sample) => survival_band(sample, least)),
      ...samples.flatMap((sample) => [
        survival_line(sample),
        ...threshold_marks(sample.threshold_deg, "", sample.colour_of_marks),
        ...overall_marks(sample.overall, sample.colour_of_marks),
      ]),
      survival_tip(samples),
    ],
  });
}
