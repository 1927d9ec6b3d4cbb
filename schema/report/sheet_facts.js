// The figures of the picked sheet next to its folding, and what can be done with it next.
import { command } from "./candidate.js";
import { certified, h, number, percent } from "./format.js";
import { metric_of, with_unit } from "./metrics.js";
import { is_pattern, noun } from "./page_kind.js";

// The metrics that say what a sheet is worth, where it has them.
const kFirst = [
  "deploys_from_deg",
  "miscut_margin_mm",
  "slope_min_mm_per_deg",
  "stroke_max",
  "critical_friction_n_mm_per_mm",
  "reverses_at_deg",
];

const fact = (name, value, about) =>
  h("div", { title: about }, h("dt", {}, name), h("dd", {}, value));

/** Facts of a draw with these values. */
export function show_sheet_facts(box, report, draw, values, detail) {
  const known = kFirst.filter(
    (name) => metric_of[name] && values[name] !== undefined && values[name] !== null,
  );
  const certificate = report.certificates?.find((entry) => entry.draw === draw),
    yields = report.yields?.findLast((entry) => entry.draw === draw),
    friction = detail?.let_go?.critical_friction_n_mm_per_mm;
  box.replaceChildren(
    ...known.map((name) =>
      fact(metric_of[name].label, with_unit(metric_of[name], values[name]), metric_of[name].about),
    ),
    ...(friction && !known.includes("critical_friction_n_mm_per_mm")
      ? [
          fact(
            "critical friction",
            `${number(friction)} N mm/mm`,
            "Hinge friction at which the sheet just reaches flat by itself",
          ),
        ]
      : []),
    fact(
      "certificate",
      certificate ? certified(certificate.certified_deg) : "none yet",
      "Angle up to which `misalign certify` has proved that the sheet folds in one way and every diagonal is monotone",
    ),
    ...(yields
      ? [
          fact(
            "yield",
            percent(yields.share),
            `Share of copies cut within ±${yields.amplitude_mm} mm that deploy`,
          ),
        ]
      : []),
  );
}

/** The commands that usually follow, with a button to copy each. */
export function show_next(box, report, draw, state, { has_certificate, is_accepted }) {
  const { misalign, catalogue, springs } = report.commands,
    whose = is_pattern(report) ? catalogue : `${catalogue} ${draw}`,
    chosen = is_pattern(report) ? catalogue : `${catalogue} --draw ${draw}`,
    stem = is_pattern(report) ? "sheet" : `${noun(report)}-${draw}`;
  const steps = [
    [
      "Will it work? A card with every requirement:",
      `card ${whose}${springs} --output card-${draw}.html`,
      "next-card",
    ],
    ...(has_certificate ? [] : [["Proof of its motion:", `certify ${whose}`, "next-certify"]]),
    ...(is_accepted
      ? [
          [
            "Drawings to cut:",
            `export ${chosen} --format svg${springs} --output ${stem}`,
            "next-svg",
          ],
        ]
      : []),
  ];
  box.replaceChildren(
    h("h2", { class: "small" }, "Next"),
    ...steps.map(([about, words, id]) => command(about, `${misalign} ${words}`, state, id)),
  );
}
