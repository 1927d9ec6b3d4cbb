// Writes numbers and words for readers, and makes the elements that hold them.

const kMinus = "\u2212";

/** A number with significant digits; powers of ten where it has many zeros. */
export function number(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-4 && size < 1e7) {
    const decimals = Math.max(0, Math.min(8, digits - 1 - Math.floor(Math.log10(size))));
    return Number(size.toFixed(decimals))
      .toLocaleString("en", {
        maximumFractionDigits: decimals,
        minimumFractionDigits: size < 1000 ? decimals : 0,
      })
      .replace(/^/, value < 0 ? kMinus : "");
  }
  const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
  return `${mantissa.replace("-", kMinus)} × 10${superscript(Number(exponent))}`;
}

const superscript = (exponent) => String(exponent).replace(/./g, (c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻");

/** Powers of ten between two positive numbers, and their text on an axis. */
export function powers(least, most) {
  const first = Math.ceil(Math.log10(least) - 1e-9),
    last = Math.floor(Math.log10(most) + 1e-9);
  return Array.from({ length: Math.max(0, last - first + 1) }, (_, i) => 10 ** (first + i));
}
export function power(value) {
  const exponent = Math.round(Math.log10(value));
  return exponent >= -2 && exponent <= 4
    ? value.toLocaleString("en")
    : `10${superscript(exponent)}`;
}

export const count = (value) => (value ?? 0).toLocaleString("en");
export const fixed = (value, decimals) =>
  value === null || value === undefined ? "–" : value.toFixed(decimals).replace("-", kMinus);
export const percent = (share, digits = 3) =>
  share === null || share === undefined ? "–" : `${number(100 * share, digits)} %`;
export const signed_percent = (share, decimals = 2) =>
  `${share >= 0 ? "+" : kMinus}${(100 * Math.abs(share)).toFixed(decimals)} %`;
/** An angle with at most two decimals. */
export const degrees = (value) =>
  value === null || value === undefined
    ? "–"
    : `${Number(value.toFixed(2)).toString().replace("-", kMinus)}°`;

/** A certified angle: rounded down. */
export const certified = (value) =>
  value === null || value === undefined ? "–" : degrees(Math.floor(100 * value) / 100);

export const plural = (n, one, many = one + "s") => `${count(n)} ${n === 1 ? one : many}`;
export const dashed = (name) => name.replace("-", "–");

export const clamp = (value, least, most) => Math.max(least, Math.min(most, value));

/** The least and the largest value, of any number; null left out. */
export function extent(values) {
  let [least, most] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    least = Math.min(least, value);
    most = Math.max(most, value);
  }
  return [least, most];
}

/** Returns whether two of the values differ; null left out. */
export function differ(values) {
  const [least, most] = extent(values);
  return least < most;
}

export const by_id = (id) => document.getElementById(id);

/** Keys with modifiers belong to the browser: Alt with an arrow goes back. */
export const with_modifier = ({ altKey, ctrlKey, metaKey, shiftKey }) =>
  altKey || ctrlKey || metaKey || shiftKey;

/** An element in one line: h("p", { class: "note" }, "text", child). */
export function h(tag, attributes = {}, ...children) {
  const node = tag.startsWith("svg:")
    ? document.createElementNS("http://www.w3.org/2000/svg", tag.slice(4))
    : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) node.addEventListener(name.slice(2), value);
    else node.setAttribute(name, value === true ? "" : value);
  }
  node.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return node;
}

/** A table of rows; a head is [words, title], and one without words an empty cell. */
export const table = (attributes, heads, rows) =>
  h(
    "table",
    attributes,
    h(
      "thead",
      {},
      h(
        "tr",
        {},
        heads.map(([words, title]) => (words ? h("th", { scope: "col", title }, words) : h("td"))),
      ),
    ),
    h("tbody", {}, rows),
  );

/** The cell of one of two values. */
export const compared = (value, is_better) =>
  h("td", is_better ? { class: "better", title: "The better of the two" } : {}, value);

/** An entry of a legend. */
export const legend_entry = (colour, words, title) =>
  h("li", { title }, h("i", { style: `background: ${colour}` }), words);
