// Saves rows as CSV and drawings as SVG and PNG, within the browser.
import { h } from "./format.js";
import { png_of, standalone_svg } from "./picture.js";

export function download(blob, name) {
  const link = h("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

export const save_text = (text, type, name) => download(new Blob([text], { type }), name);

/** A CSV field by RFC 4180. */
function field(value) {
  if (value === null || value === undefined || Number.isNaN(value)) return "";
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

/** A single-precision value, to the seven digits that it holds. */
export const single = (value) => (Number.isFinite(value) ? Number(value.toPrecision(7)) : null);

/** { heads: [name…], rows: [[value…]…] } as text. */
export const csv_text = ({ heads, rows }) =>
  [heads, ...rows].map((row) => row.map(field).join(",") + "\r\n").join("");

/**
 * Adds buttons that save a card's contents; replaces earlier ones. `csv()` returns heads and rows,
 * `svg()` a drawing in the document, `canvas()` a painted one; those left out have no button.
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
    CSV: "Save data as CSV",
    PNG: "Save picture as PNG",
    SVG: "Save drawing as SVG",
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

/** Adds buttons for a box's drawing once; later drawings are saved by the same buttons. */
export function add_saving_once(box, name, csv) {
  const card = box.closest(".card");
  if (card.querySelector(":scope > .saving")) return;
  add_saving(card, { name, csv, svg: () => box.querySelector("svg") });
}
