// The springs of the folding picture: which diagonals have one, and how hard it pulls or pushes.

/** Returns whether a diagonal has a spring: all have, unless some never pull or push. */
function has_spring({ actuators, diagonals }, { force_n }, d) {
  if (actuators.fill?.kind !== "springs") return false;
  return !force_n || force_n.some((force, k) => k % diagonals.length === d && force !== 0);
}

/**
 * Diagonals that lengthen and those that shorten as the sheet folds: { pairs, numbers, colour,
 * pushes }. `is_wanted` is told whether a diagonal has a spring.
 */
export function kinds_of_springs(report, decoded, is_wanted) {
  const { grows } = decoded;
  return [false, true].map((pushes) => {
    const numbers = report.diagonals
      .map((_, d) => d)
      .filter((d) => grows[d] !== pushes && is_wanted(has_spring(report, decoded, d)));
    const pairs = numbers.map((d) => {
      const { from_vertex, to_vertex } = report.diagonals[d];
      return [from_vertex, to_vertex];
    });
    return { pairs, numbers, colour: pushes ? "shrinks" : "grows", pushes };
  });
}

/**
 * Returns a function of a sample and a diagonal: its spring's force as a share of the largest one
 * up to D. Springs that are equal and relaxed when flat have one in proportion to their elongation.
 */
export function share_of_force(report, decoded) {
  const count = report.diagonals.length,
    { force_n, flat_mm, relative, depth } = decoded;
  const force = (k, d) =>
    Math.abs(force_n ? force_n[k * count + d] : (relative(k, d) - 1) * flat_mm[d]);
  let most = 0;
  for (let k = 0; k <= depth; ++k)
    for (let d = 0; d < count; ++d) most = Math.max(most, force(k, d));
  return (k, d) => (most > 0 ? Math.min(1, force(k, d) / most) : 0);
}
