// Bins points into hexagons, which touch each other and have a corner at the top.

const kRoot3 = Math.sqrt(3);

/** [{ x, y, count }]: the hexagons of a radius in which the rows' points lie, and their numbers. */
export function hexagons_of(xs, ys, rows, radius) {
  const wide = kRoot3 * radius,
    tall = 1.5 * radius,
    found = new Map();
  // Centres of even lines are at multiples of `wide`, those of odd lines halfway between.
  const centre = (x, y, line) => {
    const shift = line % 2 === 0 ? 0 : 0.5,
      column = Math.round(x / wide - shift) + shift;
    return { column, line, away: (x - column * wide) ** 2 + (y - line * tall) ** 2 };
  };
  for (const row of rows) {
    const [x, y] = [xs[row], ys[row]],
      line = Math.floor(y / tall);
    const [above, below] = [centre(x, y, line), centre(x, y, line + 1)],
      nearest = below.away < above.away ? below : above;
    const key = `${nearest.column} ${nearest.line}`,
      hexagon = found.get(key);
    if (hexagon) ++hexagon.count;
    else found.set(key, { x: nearest.column * wide, y: nearest.line * tall, count: 1 });
  }
  return [...found.values()];
}

/** The corners of a hexagon, clockwise from the top. */
export const corners_of = (x, y, radius) =>
  Array.from({ length: 6 }, (_, k) => [
    x + radius * Math.sin((k * Math.PI) / 3),
    y - radius * Math.cos((k * Math.PI) / 3),
  ]);
