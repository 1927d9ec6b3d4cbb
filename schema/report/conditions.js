// Reads and writes conditions in the filter's text: "stroke_max >= 0.02 stroke_max <= 0.06".

const kNumber = "[+\\-]?[0-9.]+(?:e[+\\-]?[0-9]+)?";
const kBounds = { least: ">=", most: "<=" };

const pattern_of = (name, sign) => new RegExp(`(^|\\s)${name} ${sign} (${kNumber})(?=\\s|$)`, "g");

/** The filter with these bounds of a column instead of its present ones; null: no bound. */
export function with_bounds(filter, name, bounds) {
  let text = filter;
  for (const [bound, sign] of Object.entries(kBounds)) {
    if (!(bound in bounds)) continue;
    text = text.replace(pattern_of(name, sign), " ");
    if (bounds[bound] !== null) text += ` ${name} ${sign} ${bounds[bound]}`;
  }
  return text.replace(/\s+/g, " ").trim();
}

/** { least, most } of a column's conditions; null where there is none. */
export function bounds_in(filter, name) {
  const found = Object.entries(kBounds).map(([bound, sign]) => {
    const value = pattern_of(name, sign).exec(filter)?.[2];
    return [bound, value === undefined || !Number.isFinite(Number(value)) ? null : Number(value)];
  });
  return Object.fromEntries(found);
}

/** All conditions as the option `--where` takes them; empty where there is none. */
export const as_sql = (filter) =>
  [...filter.matchAll(new RegExp(`(?:^|\\s)([a-z]\\w*) (>=|<=) (${kNumber})(?=\\s|$)`, "g"))]
    .map(([, name, sign, value]) => `${name} ${sign} ${value}`)
    .join(" AND ");
