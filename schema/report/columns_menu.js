// Shows a box for each column of the table, and a button for each that the page lacks. State
// "columns" is the choice.
import { by_id, h } from "./format.js";
import { missing_columns, offer_of } from "./missing_columns.js";
import { chosen_columns, columns_of, is_fixed, words_of } from "./table_columns.js";

/** Buttons for the columns that the page lacks; each shows the command that adds its column. */
function offers(report, candidates) {
  const missing = missing_columns(candidates);
  if (missing.length === 0) return [];
  const place = h("div", { role: "status" });
  const button = ({ name, label, about }) =>
    h(
      "button",
      {
        type: "button",
        title: about,
        "data-testid": `missing-${name}`,
        onclick: () => place.replaceChildren(offer_of(report, name)),
      },
      label,
    );
  return [
    h("p", {}, "Columns that this page lacks, each with the command that adds it:"),
    h("div", { class: "missing" }, missing.map(button)),
    place,
  ];
}

export function make_columns_menu(report, candidates, state) {
  const all = columns_of(candidates).filter((column) => !is_fixed(column));
  const is_shown = (column) => chosen_columns(candidates, state.get("columns")).includes(column);
  const toggle = (column, wanted) => {
    const now = chosen_columns(candidates, state.get("columns"));
    const next = wanted ? [...now, column] : now.filter((other) => other !== column);
    state.set("columns", words_of(candidates, next));
  };
  const boxes = all.map((column) => {
    const box = h("input", { type: "checkbox", "data-testid": `show-${column.name}` });
    box.addEventListener("change", () => toggle(column, box.checked));
    return box;
  });
  const show = () => {
    const count = all.filter(is_shown).length;
    for (const [k, column] of all.entries()) {
      boxes[k].checked = is_shown(column);
      boxes[k].disabled = boxes[k].checked && count === 1; // at least one stays
    }
  };
  by_id("columns-menu").append(
    h(
      "p",
      {},
      "To move a column, drag its heading, or press Alt and an arrow key on it. The page’s address keeps the choice. ",
      h(
        "button",
        { type: "button", "data-testid": "all-columns", onclick: () => state.set("columns", "") },
        "All columns",
      ),
    ),
    h(
      "div",
      { class: "boxes" },
      all.map((column, k) => h("label", { title: column.about }, boxes[k], ` ${column.label}`)),
    ),
    ...offers(report, candidates),
  );
  state.on("columns", show);
  show();
}
