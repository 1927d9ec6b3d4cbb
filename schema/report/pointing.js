// The pointer and the outlines on the screen below it.
import { clamp } from "./format.js";

/** Distance of a point from a segment, on the screen. */
export function distance_from([x, y], [x1, y1], [x2, y2]) {
  const along =
      ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / ((x2 - x1) ** 2 + (y2 - y1) ** 2 || 1),
    t = clamp(along, 0, 1);
  return Math.hypot(x - x1 - t * (x2 - x1), y - y1 - t * (y2 - y1));
}

/** Returns whether a point lies within a convex outline. */
export function is_within([x, y], outline) {
  const sides = outline.map(([x1, y1], i) => {
    const [x2, y2] = outline[(i + 1) % outline.length];
    return (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1);
  });
  return sides.every((side) => side >= 0) || sides.every((side) => side <= 0);
}
