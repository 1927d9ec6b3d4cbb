// Density of the lines of parallel coordinates: the number of lines through each place. Lines with
// ends in the same cells of two neighbouring axes are counted first and followed once.

/**
 * { columns, height, counts }: the number of lines per cell from the first axis to the last, column
 * after column; cells are squares of `cell` px. An axis has its place `x` and the places `ys` of all
 * rows, NaN for those without a value. A steep line counts once in each column, spread over the
 * cells that it passes.
 */
export function line_density(axes, rows, { height: height_px, cell }) {
  const columns = Math.max(1, Math.ceil((axes.at(-1).x - axes[0].x) / cell)),
    height = Math.ceil(height_px / cell),
    counts = new Float32Array(columns * height);
  for (let k = 0; k + 1 < axes.length; ++k) {
    const [from, to] = [axes[k], axes[k + 1]].map(({ x, ys }) => ({
      x: (x - axes[0].x) / cell,
      ys,
    }));
    const lines = lines_between(from, to, rows, { height, cell });
    for (let column = Math.ceil(from.x); column < Math.min(columns, Math.ceil(to.x)); ++column)
      add_column(lines, column - from.x, counts, column * height, height);
  }
  return { columns, height, counts };
}

/** The lines between two axes: starts, slopes in cells per column, and numbers of equal ones. */
function lines_between(from, to, rows, { height, cell }) {
  const numbers = new Uint32Array(height * height);
  for (const row of rows) {
    const sum = from.ys[row] + to.ys[row];
    if (Number.isNaN(sum)) continue;
    const start = Math.floor(from.ys[row] / cell),
      end = Math.floor(to.ys[row] / cell);
    ++numbers[start * height + end];
  }
  const [starts, slopes, weights] = [[], [], []];
  for (let ends = 0; ends < numbers.length; ++ends) {
    const number = numbers[ends];
    if (number === 0) continue;
    const start = Math.floor(ends / height);
    starts.push(start + 0.5);
    slopes.push(((ends % height) - start) / (to.x - from.x));
    weights.push(number);
  }
  return { starts, slopes, weights };
}

const kRounding = 1e-6; // of sums of shares; far below any line's share

function add_column({ starts, slopes, weights }, along, counts, offset, height) {
  const changes = new Float64Array(height + 1);
  for (let i = 0; i < starts.length; ++i) {
    const y = starts[i] + along * slopes[i],
      half = Math.abs(slopes[i]) / 2;
    const top = Math.max(0, Math.floor(y - half)),
      below = Math.min(height, Math.floor(y + half) + 1),
      share = weights[i] / (below - top);
    changes[top] += share;
    changes[below] -= share;
  }
  let sum = 0;
  for (let y = 0; y < height; ++y) {
    sum += changes[y];
    if (sum > kRounding) counts[offset + y] = sum;
  }
}

/** The lower quartile, median and upper quartile of the rows' places; null without any. */
export function quartiles_of(ys, rows) {
  const known = new Float32Array(rows.length);
  let count = 0;
  for (const row of rows) if (!Number.isNaN(ys[row])) known[count++] = ys[row];
  const sorted = known.subarray(0, count).sort();
  if (sorted.length === 0) return null;
  return [0.25, 0.5, 0.75].map((share) => sorted[Math.floor(share * (sorted.length - 1))]);
}
