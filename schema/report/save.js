// Saves what is shown as files: rows as CSV, drawings as SVG and PNG. Nothing leaves the browser.
import { h } from "./format.js";
import { png_of, standalone_svg } from "./picture.js";

function download(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export const save_text = (text, type, name) => download(new Blob([text], { type }), name);

/** A field as RFC 4180 has it; seven digits of what was stored with seven. */
function field(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

export const single = (value) => (Number.isFinite(value) ? Number(value.toPrecision(7)) : null);

/** { heads: [name…], rows: [[value…]…] } as text. */
export const csv_text = ({ heads, rows }) =>
  [heads, ...rows].map((row) => row.map(field).join(",") + "\r\n").join("");

/**
 * Buttons that save what a card shows, at its head; those before are replaced. `csv()` gives heads
 * and rows, `svg()` a drawing that is in the document, `canvas()` a painted one; what is left out
 * has no button.
 */
export function add_saving(card, { name, csv, svg, canvas }) {
  const file = typeof name === "function" ? name : () => name;
  const save_png = async () => {
    const blob = svg
      ? await png_of(standalone_svg(svg(), card.querySelectorAll(".legend li")))
      : await new Promise((done) => canvas().toBlob(done, "image/png"));
    download(blob, `${file()}.png`);
  };
  const kinds = {
    CSV: csv && (() => save_text(csv_text(csv()), "text/csv", `${file()}.csv`)),
    PNG: (svg || canvas) && save_png,
    SVG:
      svg &&
      (() =>
        save_text(
          new XMLSerializer().serializeToString(
            standalone_svg(svg(), card.querySelectorAll(".legend li")),
          ),
          "image/svg+xml",
          `${file()}.svg`,
        )),
  };
  const abouts = {
    CSV: "Save the numbers of this as CSV",
    PNG: "Save this picture as PNG",
    SVG: "Save this drawing as SVG",
  };
  card.querySelector(":scope > .saving")?.remove();
  card.prepend(
    h(
      "div",
      { class: "saving" },
      Object.entries(kinds)
        .filter(([, save]) => save)
        .map(([kind, save]) =>
          h(
            "button",
            {
              type: "button",
              title: abouts[kind],
              "data-testid": `save-${kind.toLowerCase()}`,
              onclick: save,
            },
            kind,
          ),
        ),
    ),
  );
}

/** The same of a drawing in a box, once: what is saved is asked for when it is wanted. */
export function add_saving_once(box, name, csv) {
  const card = box.closest(".card");
  if (card.querySelector(":scope > .saving")) return;
  add_saving(card, { name, csv, svg: () => box.querySelector("svg") });
}
