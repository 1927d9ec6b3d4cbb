// The figures of the picked sheet next to its folding.
import { h } from "./format.js";
import { metric_of, with_unit } from "./metrics.js";

const kFirst = [
  "deploys_from_deg",
  "miscut_margin_mm",
  "slope_min_mm_per_deg",
  "stroke_max",
  "critical_friction_n_mm_per_mm",
  "reverses_at_deg",
  "certified_deg",
  "yield",
];

/** Shows the values that a draw has; a certificate is missed where there is none. */
export function show_sheet_facts(box, report, draw, values, detail) {
  const of_draw = (list) => list?.findLast((entry) => entry.draw === draw),
    found = {
      critical_friction_n_mm_per_mm: detail?.let_go?.critical_friction_n_mm_per_mm,
      ...values,
      certified_deg: of_draw(report.certificates)?.certified_deg ?? null,
      yield: of_draw(report.yields)?.share,
    };
  const known = kFirst.filter(
    (name) => name === "certified_deg" || (found[name] !== undefined && found[name] !== null),
  );
  box.replaceChildren(
    ...known.map((name) => {
      const metric = metric_of[name];
      return h(
        "div",
        { title: metric.about },
        h("dt", {}, metric.label),
        h("dd", {}, with_unit(metric, found[name])),
      );
    }),
  );
}
