// The commands that continue from a sheet, each with a button that copies it.
import { copy_button, unbroken } from "./copying.js";
import { h } from "./format.js";
import { is_pattern, noun } from "./page_kind.js";

/** A command under its description, whose `title` is shown under the pointer. */
export function command(about, text, id, title) {
  const code = h("code", { "data-testid": id }, unbroken(text));
  return h(
    "div",
    { class: "command" },
    h("p", { title }, about),
    h("div", { class: "row" }, code, copy_button(text)),
  );
}

/** The command of this page, with one more option. */
export function report_command({ commands }, option) {
  const { misalign, catalogue, choice, springs, output } = commands;
  return `${misalign} report ${catalogue} ${option}${choice}${springs} --output ${output}`;
}

/** The usual next steps: [description, command without its program, id of tests]. */
function next_of(report, draw, { is_accepted, is_certified }) {
  const { springs } = report.commands,
    { whose, exported } = words_of(report, draw);
  return [
    [
      "Card to print: requirements of the design, results, and springs to buy:",
      `card ${whose}${springs} --output card-${draw}.html`,
      "command-card",
    ],
    ...(is_certified ? [] : [["Proof of its motion:", `certify ${whose}`, "command-certify"]]),
    ...(is_accepted
      ? [["Crease pattern at scale 1:1, in layers for a cutter:", exported("svg"), "command-svg"]]
      : []),
  ];
}

/** All others. */
function further_of(report, draw, { is_accepted, deploys }) {
  const is_file = is_pattern(report),
    { springs } = report.commands,
    { whose, exported } = words_of(report, draw);
  return [
    is_file
      ? ["Path of this sheet, degree by degree:", `fold ${whose}`, "command-fold"]
      : [`Path of this ${noun(report)}, degree by degree:`, `replay ${whose}`, "command-replay"],
    is_file && [
      "Verification: its path by two solvers, its folded shapes by their coordinates:",
      `verify ${whose}`,
      "command-verify",
    ],
    ...(is_accepted
      ? [
          ["Pattern, verdict, metrics and springs as JSON:", exported("json"), "command-json"],
          ["Histories of the diagonals as CSV:", exported("csv"), "command-csv"],
          ["Folded states as FOLD, for other programs:", exported("fold"), "command-folded"],
        ]
      : []),
    ["Springs on its diagonals:", `actuators ${whose}${springs}`, "command-actuators"],
    deploys && [
      "Yield: share of copies with cutting errors up to 0.05 mm that deploy (--vertices: the most sensitive vertices):",
      `tolerance ${whose} --amplitude 0.05`,
      "command-tolerance",
    ],
  ].filter(Boolean);
}

/** The parts of commands that name the sheet. */
function words_of(report, draw) {
  const { catalogue, springs } = report.commands,
    [whose, chosen, folder] = is_pattern(report)
      ? [catalogue, catalogue, "exported"]
      : [`${catalogue} ${draw}`, `${catalogue} --draw ${draw}`, `${noun(report)}-${draw}`];
  const exported = (format) => `export ${chosen} --format ${format}${springs} --output ${folder}`;
  return { whose, exported };
}

/** Shows what comes next, and all others. `sheet`: { is_accepted, is_certified, deploys }. */
export function show_commands(next, further, report, draw, sheet) {
  const commands = (list) =>
    list.map(([about, words, id]) => command(about, `${report.commands.misalign} ${words}`, id));
  next.replaceChildren(
    h("h2", { class: "small" }, "Next"),
    ...commands(next_of(report, draw, sheet)),
  );
  further.replaceChildren(
    ...commands(further_of(report, draw, sheet)),
    ...(is_pattern(report)
      ? []
      : [
          command(
            `This report, with this ${noun(report)} first:`,
            report_command(report, `--draw ${draw}`),
            "command-again",
          ),
        ]),
  );
}
