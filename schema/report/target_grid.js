// The surface of a sheet's target as a grid of lines, for the folding picture.
import { floats } from "./data.js";

/**
 * Points of a target's surface, which follow `first` vertices, and pairs of neighbours in its
 * grid. Nothing without a target.
 */
export function target_grid(target, first) {
  if (!target) return { points: [], pairs: [] };
  const { columns } = target,
    points = floats(target.points_mm),
    pairs = [];
  for (let k = 0; k < points.length / 3; ++k) {
    if ((k + 1) % columns) pairs.push([first + k, first + k + 1]);
    if (k + columns < points.length / 3) pairs.push([first + k, first + k + columns]);
  }
  return { points, pairs };
}
