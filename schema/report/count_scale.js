// Colours of counts, even in lightness over the count's logarithm.
import { colour_scale } from "./colour_scale.js";
import { colour } from "./theme.js";

/** Returns the function of a count, 1 to `most`, that gives its colour in the present theme. */
export function count_scale(most) {
  const scale = colour_scale(["least", "middle", "most"].map((stop) => colour(`count-${stop}`)));
  const decades = Math.log(most) || 1;
  return (count) => scale(Math.log(count) / decades);
}

/** The counts of a legend: 1, 3, 10, 30 … and the largest. */
export function legend_counts(most) {
  const counts = [];
  for (let power = 1; power < most; power *= 10) counts.push(power, 3 * power);
  return [...counts.filter((count) => count < 0.8 * most), most];
}
