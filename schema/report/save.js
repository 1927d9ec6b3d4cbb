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
 * `svg()` a drawing in the document; those left out have no button.
 */
export function add_saving(card, { name, csv, svg }) {
  const file = typeof name === "function" ? name : () => name,
    drawing = () => standalone_svg(svg(), card.querySelectorAll(".legend li"));
  const save_csv = () => save_text(csv_text(csv()), "text/csv", `${file()}.csv`),
    save_png = async () => download(await png_of(drawing()), `${file()}.png`),
    save_svg = () => {
      const text = new XMLSerializer().serializeToString(drawing());
      save_text(text, "image/svg+xml", `${file()}.svg`);
    };
  const button = (kind, title, onclick) => {
    const id = `save-${kind.toLowerCase()}`;
    return h("button", { type: "button", title, "data-testid": id, onclick }, kind);
  };
  card.querySelector(":scope > .saving")?.remove();
  card.prepend(
    h(
      "div",
      { class: "saving" },
      csv ? button("CSV", "Save data as CSV", save_csv) : null,
      svg ? button("PNG", "Save picture as PNG", save_png) : null,
      svg ? button("SVG", "Save drawing as SVG", save_svg) : null,
    ),
  );
}

/** Adds buttons for a box's drawing once; later drawings are saved by the same buttons. */
export function add_saving_once(box, name, csv) {
  const card = box.closest(".card");
  if (card.querySelector(":scope > .saving")) return;
  add_saving(card, { name, csv, svg: () => box.querySelector("svg") });
}
