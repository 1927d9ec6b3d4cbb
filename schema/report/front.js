// The Pareto front of several objectives: rows that no other row dominates.

const sign_of = ({ better }) => (better === "less" ? 1 : -1);

/** The front of `rows`; goals: [{ values, better: "more" | "less" }]. Equal rows all stay. */
export function front_of(rows, goals) {
  const losses = new Map(
    rows.map((row) => [row, goals.map((goal) => sign_of(goal) * goal.values[row])]),
  );
  const sorted = [...rows].sort((a, b) => {
    const k = goals.findIndex((_, i) => losses.get(a)[i] !== losses.get(b)[i]);
    return k < 0 ? a - b : losses.get(a)[k] - losses.get(b)[k];
  });
  // A row that dominates another comes earlier, and so does one of the front that does.
  const front = [];
  for (const row of sorted) {
    const ours = losses.get(row);
    const is_dominated = front.some((other) => {
      const its = losses.get(other);
      return its.every((loss, k) => loss <= ours[k]) && its.some((loss, k) => loss < ours[k]);
    });
    if (!is_dominated) front.push(row);
  }
  return front;
}
