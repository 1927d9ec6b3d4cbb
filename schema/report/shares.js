// Estimates shares of all draws from the fault sample, whose rows are weighted.

export function sum(rows, value = (row) => row.sampled) {
  return rows.reduce((total, row) => total + value(row), 0);
}

/** The number of draws that a row represents. */
export const weight = (row) => row.weight;

/** Effective sample size: (sum w)^2 / sum w^2 (Kish, 1965, section 11.7). */
export function effective(rows) {
  return sum(rows, weight) ** 2 / sum(rows, (row) => row.weight_sq);
}

/** Wilson's 95 % interval of k in n. */
function interval(k, n) {
  const z = 1.96,
    p = k / n,
    middle = (p + (z * z) / (2 * n)) / (1 + (z * z) / n);
  const half = (z / (1 + (z * z) / n)) * Math.sqrt((p * (1 - p)) / n + (z * z) / (4 * n * n));
  // Rounding must not put p outside.
  return [Math.max(0, Math.min(p, middle - half)), Math.min(1, Math.max(p, middle + half))];
}

/** The share without a fault after each angle of a fault, with its interval. */
export function survival_points(rows, { path }) {
  const total = sum(rows, weight),
    trials = effective(rows);
  const failed_at = new Map();
  for (const row of rows) {
    const { first_fault, fault_deg, sampled } = row;
    if (first_fault === "none") continue;
    const angle = fault_deg ?? 0; // a fault at all angles
    const before = failed_at.get(angle) ?? { sampled: 0, weight: 0 };
    failed_at.set(angle, {
      sampled: before.sampled + sampled,
      weight: before.weight + weight(row),
    });
  }
  let left = sum(rows),
    left_weight = total;
  return [...new Set([0, ...failed_at.keys(), path.end_deg])]
    .sort((a, b) => a - b)
    .map((angle) => {
      left -= failed_at.get(angle)?.sampled ?? 0;
      left_weight -= failed_at.get(angle)?.weight ?? 0;
      const share = left > 0 ? left_weight / total : 0,
        [low, high] = interval(share * trials, trials);
      return { angle, share, left, low, high };
    });
}

/**
 * The difference of two shares with its interval, by Newcombe's square-and-add rule (Statistics in
 * Medicine 17, 1998): { difference, low, high } from two of { rate, rate_low, rate_high }.
 */
export function difference_of(first, second) {
  const difference = first.rate - second.rate;
  return {
    difference,
    low: difference - Math.hypot(first.rate - first.rate_low, second.rate_high - second.rate),
    high: difference + Math.hypot(first.rate_high - first.rate, second.rate - second.rate_low),
  };
}
