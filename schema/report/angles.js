// Charts the number of candidates that deploy from each angle or beyond.
import * as Plot from "@observablehq/plot";
import { log_chart, show_when_wide } from "./chart.js";
import { by_id, count, degrees, plural, power, powers } from "./format.js";
import { add_saving_once } from "./save.js";

/** Cumulative counts of [[angle, count of candidates whose D it is]…], ascending. */
export function at_least(angles) {
  let beyond = 0;
  return [...angles]
    .reverse()
    .map(([angle, reached]) => ({ angle, reached, beyond: (beyond += reached) }))
    .reverse();
}

function angles_chart(points, { path, accept }, width) {
  const most = 10 ** Math.max(1, Math.ceil(Math.log10(points[0].beyond) - 1e-9)),
    from_deg = accept.deploys_from_deg,
    steps = [{ angle: from_deg, beyond: points[0].beyond }, ...points];
  const best = points.at(-1);
  return log_chart({
    ...{ width, height: 240, marginRight: 24 },
    ariaLabel: "Candidates that deploy from each angle or beyond",
    ariaDescription: `${plural(points[0].beyond, "candidate")} from ${degrees(from_deg)} on, ${count(best.beyond)} from ${degrees(best.angle)}`,
    x: {
      label: "pilot angle (°)",
      domain: [from_deg, Math.max(path.end_deg, from_deg + path.sample_deg)],
    },
    y: {
      label: "candidates with D at this angle or beyond (log scale)",
      domain: [0.7, most],
      ticks: powers(1, most),
      tickFormat: power,
    },
    marks: [
      Plot.areaY(steps, {
        ...{ x: "angle", y1: 0.7, y2: "beyond", curve: "step-before" },
        ...{ fill: "var(--accent)", fillOpacity: 0.18 },
      }),
      Plot.lineY(steps, {
        ...{ x: "angle", y: "beyond", curve: "step-before" },
        ...{ stroke: "var(--accent)", strokeWidth: 2 },
      }),
      Plot.dot([best], { x: "angle", y: "beyond", fill: "var(--pick)", r: 4 }),
      Plot.tip(
        points,
        Plot.pointerX({
          x: "angle",
          y: "beyond",
          title: ({ angle, reached, beyond }) =>
            `${degrees(angle)} or more: ${plural(beyond, "candidate")}\n${count(reached)} with D = ${degrees(angle)}`,
        }),
      ),
    ],
  });
}

/** Hides the card where the report has no such counts. */
export function show_angles(report) {
  const points = at_least(report.live?.angles ?? []),
    box = by_id("angles"),
    { name, configuration } = report.campaign;
  by_id("angles-card").hidden = points.length === 0;
  if (points.length === 0) return;
  const best = points.at(-1);
  by_id("angles-caption").textContent =
    `All ${plural(points[0].beyond, "candidate")} of the catalogue; ${best.beyond === 1 ? "one deploys" : `${count(best.beyond)} deploy`} from ${degrees(best.angle)}.`;
  show_when_wide(box, (width) => angles_chart(points, configuration, width));
  add_saving_once(box, `${name}-angles`, () => ({
    heads: ["deploys_from_deg", "candidates", "candidates_from_there_on"],
    rows: at_least(report.live.angles).map(({ angle, reached, beyond }) => [
      angle,
      reached,
      beyond,
    ]),
  }));
}
