// Finds the sampled draws that came in between two states of the fault sample, and the marks that
// stand for them.
import { sum, weight } from "./shares.js";

const key_of = ({ first_fault, fault_deg, where, accepted }) =>
  JSON.stringify([first_fault, fault_deg, where, accepted]);

/** The rows by which a sample has grown; none if it did anything but grow. */
export function rows_since(before, now) {
  const known = new Map(before.map((row) => [key_of(row), row]));
  const more = now
    .map((row) => {
      const old = known.get(key_of(row)) ?? { sampled: 0, weight: 0 };
      return { ...row, sampled: row.sampled - old.sampled, weight: row.weight - old.weight };
    })
    .filter((row) => row.sampled !== 0);
  const has_grown = more.every((row) => row.sampled > 0) && sum(more) === sum(now) - sum(before);
  return has_grown ? more : [];
}

/** Numbers in [0, 1) that are the same at every call (mulberry32). */
export function random_numbers(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let word = Math.imul(state ^ (state >>> 15), state | 1);
    word ^= word + Math.imul(word ^ (word >>> 7), word | 61);
    return ((word ^ (word >>> 14)) >>> 0) / 2 ** 32;
  };
}

function shuffled(list, random) {
  for (let i = list.length - 1; i > 0; --i) {
    const j = Math.floor(random() * (i + 1));
    [list[i], list[j]] = [list[j], list[i]];
  }
  return list;
}

/** Returns whether the draws of a row have a place on the axis of pilot angles. */
export const has_angle = ({ first_fault, fault_deg }) =>
  first_fault === "none" || fault_deg !== null;

/**
 * Takes rows for marks, `most` at most, in random order by a fixed seed. Each represents the same
 * number of draws (systematic sampling by weight): a mark is a sampled draw where all fit and
 * weigh the same.
 */
export function marks_of(rows, most, random) {
  const placed = rows.filter(has_angle),
    all = sum(placed, weight),
    total = Math.min(most, sum(placed)),
    represents = total > 0 ? all / total : 0,
    marks = [];
  let passed = 0;
  for (const row of placed) {
    passed += weight(row);
    while (marks.length < total && (marks.length + 0.5) * represents < passed) marks.push(row);
  }
  return { marks: shuffled(marks, random), represents };
}
