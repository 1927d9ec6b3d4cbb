// The front of several goals: rows than which no other is at least as good in all and better in one.

const sign_of = ({ better }) => (better === "less" ? 1 : -1);

/** Of `rows`, in any order; goals: [{ values, better: "more" | "less" }]. Equals stay together. */
export function front_of(rows, goals) {
  const losses = new Map(
    rows.map((row) => [row, goals.map((goal) => sign_of(goal) * goal.values[row])]),
  );
  const sorted = [...rows].sort((a, b) => {
    const k = goals.findIndex((_, i) => losses.get(a)[i] !== losses.get(b)[i]);
    return k < 0 ? a - b : losses.get(a)[k] - losses.get(b)[k];
  });
  // Whoever is better in all comes earlier, and one of the front is.
  const front = [];
  for (const row of sorted) {
    const own = losses.get(row);
    const is_worse = front.some((other) => {
      const its = losses.get(other);
      return its.every((loss, k) => loss <= own[k]) && its.some((loss, k) => loss < own[k]);
    });
    if (!is_worse) front.push(row);
  }
  return front;
}
