// The columns of the candidates' table: choice, widths, and the order of rows.
import { count, extent } from "./format.js";
import { metrics } from "./metrics.js";
import { text_width } from "./text_size.js";

const kPadding_px = 16,
  kLooked = 60; // rows that set a width, with the column's least and largest value

const kFixed = [
  { name: "rank", label: "rank", unit: "", about: "Rank in the program's order: best first." },
  {
    name: "draw",
    label: "draw",
    unit: "",
    about: "Number of the draw, or of a population's sheet. Dot: all details in this report.",
  },
];
const columns = [...kFixed.map((column) => ({ ...column, better: "less" })), ...metrics];

/** "-stroke_min" → { name, descending }; "": the program's own order. */
export const order_of = (words) => ({
  name: words.replace(/^-/, "") || "rank",
  descending: words.startsWith("-"),
});

export const columns_of = (candidates) =>
  columns.filter(({ name }) => name === "rank" || candidates.columns[name]);

/** Returns whether a column is always there, before the others. */
export const is_fixed = ({ name }) => kFixed.some((column) => column.name === name);

/** "stroke_max,yield" → the fixed columns and these, in this order; "": all columns. */
export function chosen_columns(candidates, words) {
  const all = columns_of(candidates);
  if (!words) return all;
  const named = words.split(",").map((name) => all.find((column) => column.name === name));
  return [...all.filter(is_fixed), ...named.filter((column) => column && !is_fixed(column))];
}

/** The inverse of chosen_columns. */
export function words_of(candidates, chosen) {
  const names = (list) =>
    list
      .filter((column) => !is_fixed(column))
      .map(({ name }) => name)
      .join(",");
  const words = names(chosen);
  return words === names(columns_of(candidates)) ? "" : words;
}

/** Returns whether a text names columns, at least one, that may be chosen. */
export const is_choice = (words, candidates) =>
  words
    .split(",")
    .every((name) =>
      columns_of(candidates).some((column) => column.name === name && !is_fixed(column)),
    );

/** Returns whether a text names a column to sort by. */
export const is_order = (words, candidates) =>
  columns_of(candidates).some(({ name }) => name === order_of(words).name);

export const shown = (column, value) => column.text(value).replace(/ %$/, "");

/** The width of a column, px: its heading's words are one below the other. */
export function width_of(column, { columns: values, count: rows }) {
  const texts = [];
  if (column.name === "rank") texts.push(count(rows));
  else if (column.name === "draw") {
    const longest = values.draw.reduce((most, draw) => Math.max(most, draw.length), 0);
    texts.push(`●\u00a0\u00a0${"0".repeat(longest)}`);
  } else {
    const list = values[column.name].filter((value) => value !== null);
    const step = Math.max(1, Math.floor(list.length / kLooked));
    for (const value of [
      ...(list.length ? extent(list) : []),
      ...list.filter((_, i) => i % step === 0),
    ])
      texts.push(shown(column, value));
  }
  const heading = Math.max(...column.label.split(" ").map((word) => text_width(word, 12.5))) + 12;
  const weight = column.name === "draw" ? 700 : 400;
  const body = Math.max(0, ...texts.map((text) => text_width(text, 13.5, weight)));
  return Math.ceil(Math.max(heading, text_width(column.unit, 11.5), body) + kPadding_px);
}

/**
 * The passing rows, sorted stably. Rows without a value come last, ascending and descending; in a
 * column with `none_is_best` they are the best.
 */
export function arranged(candidates, passing, { name, descending }) {
  const sign = descending ? -1 : 1,
    order = [];
  for (let row = 0; row < candidates.count; ++row) if (!passing || passing(row)) order.push(row);
  if (name === "rank") return descending ? order.reverse() : order;
  if (name === "draw") {
    const keys = candidates.columns.draw.map(BigInt);
    return order.sort((a, b) => sign * (keys[a] < keys[b] ? -1 : keys[a] > keys[b] ? 1 : 0));
  }
  const values = candidates.columns[name],
    none_first = columns.find((column) => column.name === name).none_is_best === descending;
  return order.sort((a, b) => {
    const x = values[a] ?? null,
      y = values[b] ?? null;
    if (x === null || y === null) {
      return (none_first ? -1 : 1) * ((x === null) - (y === null)) || a - b;
    }
    return sign * (x - y) || a - b;
  });
}
