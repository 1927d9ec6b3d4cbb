// Where along the folding draws fail, from the exact first faults of the sample.
import * as Plot from "@observablehq/plot";
import { count, degrees, fault_name, fault_order, percent, powers } from "./format.js";

export function sum(rows, value = (row) => row.draws) {
  return rows.reduce((total, row) => total + value(row), 0);
}

/** Wilson's 95 % interval of k in n. */
function interval(k, n) {
  const z = 1.96,
    p = k / n,
    middle = (p + (z * z) / (2 * n)) / (1 + (z * z) / n);
  const half = (z / (1 + (z * z) / n)) * Math.sqrt((p * (1 - p)) / n + (z * z) / (4 * n * n));
  return [Math.max(0, middle - half), Math.min(1, middle + half)];
}

export function faults_chart(rows, total, { path, accept }, width) {
  const bin_deg = Math.max(5, path.sample_deg);
  const bins = new Map();
  for (const { first_fault, fault_deg, draws } of rows) {
    if (fault_deg === null || first_fault === "none") continue;
    // A bin holds (from, to]: faults at 170° belong to those that fail up to 170°.
    const to = Math.ceil(fault_deg / bin_deg) * bin_deg,
      key = `${first_fault} ${to}`;
    if (!bins.has(key)) bins.set(key, { first_fault, from: to - bin_deg, to, draws: 0 });
    bins.get(key).draws += draws;
  }
  const present = fault_order.filter((fault) =>
    [...bins.values()].some((bin) => bin.first_fault === fault),
  );
  return Plot.plot({
    width,
    height: 280,
    marginLeft: 52,
    marginBottom: 42,
    className: "plot",
    ariaLabel: "First faults along the folding, stacked by kind",
    x: {
      label: "pilot fold angle of the first fault (deg)",
      domain: [0, path.end_deg],
      labelAnchor: "center",
      labelArrow: "none",
    },
    y: { label: "sampled draws (%)", grid: true, labelArrow: "none", percent: true },
    color: {
      domain: present,
      range: present.map((fault) => `var(--${fault.replaceAll("_", "-")})`),
      legend: false,
    },
    marks: [
      Plot.rectY(
        [...bins.values()].sort(
          (a, b) => present.indexOf(a.first_fault) - present.indexOf(b.first_fault),
        ),
        Plot.stackY({
          x1: "from",
          x2: "to",
          y: (bin) => bin.draws / total,
          fill: "first_fault",
          insetLeft: 0.5,
          insetRight: 0.5,
          order: present,
          title: (bin) =>
            `${fault_name(bin.first_fault)}\nabove ${bin.from}° up to ${bin.to}°\n${count(bin.draws)} of ${count(total)} draws (${percent(bin.draws / total)})`,
          tip: true,
        }),
      ),
      Plot.ruleX([accept.deploys_from_deg], { stroke: "var(--ink)", strokeDasharray: "2 3" }),
      Plot.text([accept.deploys_from_deg], {
        x: (d) => d,
        frameAnchor: "top",
        text: () => "threshold",
        textAnchor: "end",
        dx: -5,
        fill: "var(--ink)",
      }),
      Plot.ruleY([0]),
    ],
  });
}

export function survival_chart(rows, total, report, width) {
  const { path, accept } = report.campaign.configuration;
  const failed_at = new Map();
  for (const { first_fault, fault_deg, draws } of rows) {
    if (first_fault === "none") continue;
    const angle = fault_deg ?? 0; // a fault of the whole range: it deploys from nowhere
    failed_at.set(angle, (failed_at.get(angle) ?? 0) + draws);
  }
  let left = total;
  const points = [];
  for (const angle of [...new Set([0, ...failed_at.keys(), path.end_deg])].sort((a, b) => a - b)) {
    left -= failed_at.get(angle) ?? 0;
    const [low, high] = interval(left, total);
    points.push({ angle, share: left / total, left, low: Math.max(low, 0.2 / total), high });
  }
  const { rate, rate_low, rate_high } = report.state.acceptance ?? {};
  const overall =
    rate > 0 ? [{ angle: accept.deploys_from_deg, rate, low: rate_low, high: rate_high }] : [];
  const least = Math.min(0.5 / total, overall[0]?.low || 1);
  return Plot.plot({
    width,
    height: 280,
    marginLeft: 62,
    marginBottom: 42,
    className: "plot",
    ariaLabel: "Survival along the folding",
    x: {
      label: "pilot fold angle (deg)",
      domain: [0, path.end_deg],
      labelAnchor: "center",
      labelArrow: "none",
    },
    y: {
      type: "log",
      label: "share without a fault (log scale)",
      grid: true,
      labelArrow: "none",
      domain: [least, 1],
      clamp: true,
      ticks: powers(least, 1),
      tickFormat: (share) => percent(share, 1),
    },
    marks: [
      Plot.areaY(points, {
        x: "angle",
        y1: "low",
        y2: "high",
        curve: "step-after",
        fill: "var(--accent)",
        fillOpacity: 0.18,
      }),
      Plot.lineY(
        points.filter((point) => point.left > 0),
        { x: "angle", y: "share", curve: "step-after", stroke: "var(--accent)", strokeWidth: 2 },
      ),
      Plot.ruleX([accept.deploys_from_deg], { stroke: "var(--ink)", strokeDasharray: "2 3" }),
      Plot.ruleX(overall, {
        x: "angle",
        y1: "low",
        y2: "high",
        stroke: "var(--ink)",
        strokeWidth: 1.5,
      }),
      Plot.dot(overall, {
        x: "angle",
        y: "rate",
        fill: "var(--ink)",
        r: 4,
        title: (d) => `all draws: ${percent(d.rate)} accepted`,
      }),
      Plot.tip(
        points,
        Plot.pointerX({
          x: "angle",
          y: "share",
          title: (d) =>
            `${degrees(d.angle)}: ${percent(d.share)} without a fault\n${count(d.left)} of ${count(total)} draws`,
        }),
      ),
    ],
  });
}
