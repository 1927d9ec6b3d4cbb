// Parses the table's filter: conditions, all of which must hold.
//   stroke_max < 0.05 deploys_from_deg >= 172        bump_deg is none        draw = 1234        details
import { metric_of, metrics, of_studies } from "./metrics.js";
import { missing_columns } from "./missing_columns.js";

const kNames = ["draw", ...metrics.map((metric) => metric.name)];
const kToken = /\s*(?:(<=|>=|!=|==|<|>|=|≤|≥|≠)|([^\s<>=!≤≥≠,;&]+)|(,|;|&&))/y;
const kSame = { "==": "=", "≤": "<=", "≥": ">=", "≠": "!=" };
const kMirror = { "<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "!=": "!=" };
const kNone = new Set(["none", "null", "–", "-"]);

const compare = {
  "<": (a, b) => a < b,
  ">": (a, b) => a > b,
  "<=": (a, b) => a <= b,
  ">=": (a, b) => a >= b,
  "=": (a, b) => a === b,
  "!=": (a, b) => a !== b,
};

/**
 * { holds(row) } for the candidates, or { error, offers } with an error in words, and the columns of
 * studies that the page lacks and the text may mean.
 */
export function parse_filter(typed, candidates) {
  const text = with_names(typed);
  const tokens = [];
  kToken.lastIndex = 0;
  while (kToken.lastIndex < text.trimEnd().length) {
    const start = kToken.lastIndex,
      match = kToken.exec(text);
    if (!match) return { error: `“${text.slice(start).trim()[0]}” is not understood.` };
    if (match[1]) tokens.push({ sign: kSame[match[1]] ?? match[1] });
    else if (match[2] && match[2].toLowerCase() !== "and") tokens.push({ word: match[2] });
  }
  const tests = [];
  for (let i = 0; i < tokens.length;) {
    const first = tokens[i];
    if (first.sign)
      return { error: `A name is missing before “${first.sign}”, as in “stroke_max < 0.05”.` };
    if (first.word === "or")
      return { error: "“or” is not understood: all conditions must hold together." };
    if (first.word === "details") {
      tests.push((row) => candidates.detailed.has(candidates.columns.draw[row]));
      ++i;
      continue;
    }
    const is_value = number_of(first.word) !== null;
    if (is_value && /^\d+$/.test(first.word) && tokens.length === 1) {
      const made = condition("draw", "=", first.word, candidates); // a number alone names a draw
      return made.test ? { holds: made.test } : made;
    }
    if (!is_value && !kNames.includes(first.word)) return unknown_name(first.word, candidates);
    if (!is_value && !candidates.columns[first.word]) return without(first.word);
    const sign = tokens[i + 1]?.word === "is" ? "=" : tokens[i + 1]?.sign;
    const second = tokens[i + 2]?.word;
    if (!sign)
      return { error: `After “${first.word}” a comparison is missing: <, <=, >, >=, = or !=.` };
    if (second === undefined)
      return {
        error: `After “${first.word} ${sign}” a ${is_value ? "name" : "number"} is missing.`,
      };
    // 150 <= deploys_from_deg < 175: the name also begins the next condition.
    const [name, value, operator] = is_value
      ? [second, first.word, kMirror[sign]]
      : [first.word, second, sign];
    if (!kNames.includes(name)) return unknown_name(name, candidates);
    const made = condition(name, operator, value, candidates);
    if (!made.test) return made;
    tests.push(made.test);
    i += is_value && tokens[i + 3]?.sign ? 2 : 3;
  }
  return { holds: (row) => tests.every((test) => test(row)) };
}

const kName_of = Object.fromEntries(
  metrics.flatMap(({ label, name }) => [
    [name.replaceAll("_", " "), name],
    [label.toLowerCase(), name],
  ]),
);
kName_of.d = "deploys_from_deg"; // the manual's word; the paper's D is a ratio
// The longest first: “yield” begins “yield low”. A label may end in ± or ², which end no word.
const kLabels = Object.keys(kName_of).sort((a, b) => b.length - a.length);
const kLabel = new RegExp(`(?<!\\w)(?:${kLabels.join("|")})(?!\\w)`, "gi");

/** Replaces headings by the columns' names: “largest stroke < 5%”. */
const with_names = (text) =>
  text.replaceAll(/(\d)\s+%/g, "$1%").replaceAll(kLabel, (label) => kName_of[label.toLowerCase()]);

function number_of(word) {
  const match = /^([+\-−]?(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?)(%|°|deg|mm)?$/i.exec(word);
  if (!match) return null;
  return Number(match[1].replace("−", "-")) / (match[2] === "%" ? 100 : 1);
}

function condition(name, operator, word, { columns }) {
  const values = columns[name],
    holds = compare[operator];
  if (!values) return without(name);
  if (name === "draw") {
    if (!/^\d+$/.test(word)) return { error: `“${word}” is not a draw’s number.` };
    const draw = BigInt(word);
    return { test: (row) => holds(BigInt(values[row]), draw) };
  }
  if (kNone.has(word.toLowerCase())) {
    if (operator !== "=" && operator !== "!=")
      return { error: `“${word}” can be compared only by = or !=.` };
    return { test: (row) => holds(values[row] ?? null, null) };
  }
  const value = number_of(word);
  if (value === null) return { error: `“${word}” is not a number.` };
  if (metric_of[name].axis === 100 && Math.abs(value) > 1 && !word.endsWith("%"))
    return { error: `“${name}” is a share: write ${word}%, or ${value / 100}.` };
  return {
    test: (row) => values[row] !== null && values[row] !== undefined && holds(values[row], value),
  };
}

/** Says that the page lacks a metric. */
const without = (name) =>
  of_studies.has(name)
    ? { error: "", offers: [name] }
    : { error: `This catalogue has no column “${name}”.` };

const kNear = 4, // letters to change
  kLeastPart = 4, // letters of a part of a name
  kMostOffers = 4;

function unknown_name(word, candidates) {
  const present = kNames.filter((name) => candidates.columns[name]),
    missing = missing_columns(candidates).map(({ name }) => name);
  const has_part = (name) =>
    name.includes(word.toLowerCase()) || name.replaceAll("_", "").includes(word.toLowerCase());
  const nearest = (names) =>
    names
      .map((name) => [distance(word, name), name])
      .filter(([apart]) => apart <= kNear)
      .sort((a, b) => a[0] - b[0])[0]?.[1];
  const parts = word.length < kLeastPart ? [] : missing.filter(has_part);
  const guess = present.find(has_part) ?? (parts.length ? undefined : nearest(present));
  const other = guess || parts.length ? undefined : nearest(missing);
  const offers = other ? [other] : parts.slice(0, kMostOffers);
  const hint = guess
    ? `: did you mean “${guess}”?`
    : offers.length
      ? " of this page."
      : "; the list below the field has all names.";
  return { error: `“${word}” is no column${hint}`, offers };
}

function distance(a, b) {
  let row = Array.from({ length: b.length + 1 }, (_, k) => k);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let k = 1; k <= b.length; ++k) {
      next[k] = Math.min(next[k - 1] + 1, row[k] + 1, row[k - 1] + (a[i - 1] === b[k - 1] ? 0 : 1));
    }
    row = next;
  }
  return row[b.length];
}
