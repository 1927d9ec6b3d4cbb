// Paints rows of parallel coordinates: single lines, or the density of many.
import { count_scale } from "./count_scale.js";
import { line_density, quartiles_of } from "./line_density.js";
import { colour } from "./theme.js";

/** Largest number of rows that are painted as lines. */
export const kMostLines = 300;

const kCell_px = 2, // of the density
  kShades = 256;

function paint_lines(pen, axes, rows) {
  for (const row of rows) {
    let open = false;
    pen.beginPath();
    for (const { x, ys } of axes) {
      if (Number.isNaN(ys[row]))
        open = false; // no value
      else if (open) pen.lineTo(x, ys[row]);
      else {
        pen.moveTo(x, ys[row]);
        open = true;
      }
    }
    pen.stroke();
  }
}

const bytes_of = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));

/** The shades of counts from 1 to `most` over their logarithm, as bytes. */
function shades_of(quiet) {
  const soft = bytes_of(colour("ink-soft")),
    scale = count_scale(kShades);
  return Array.from({ length: kShades }, (_, k) => {
    const share = k / (kShades - 1);
    return quiet ? [...soft, 30 + 60 * share] : [...bytes_of(scale(kShades ** share)), 255];
  });
}

/** A picture of a density: a pixel for each place. */
function picture_of({ columns, height, counts }, quiet) {
  const most = counts.reduce((a, b) => Math.max(a, b), 1),
    shades = shades_of(quiet),
    per_log = (kShades - 1) / (Math.log(most) || 1);
  const image = new ImageData(columns, height),
    { data } = image;
  for (let place = 0; place < counts.length; ++place) {
    const count = counts[place];
    if (count === 0) continue;
    const shade = shades[count <= 1 ? 0 : Math.round(Math.log(count) * per_log)],
      at = 4 * ((place % height) * columns + Math.floor(place / height));
    for (let k = 0; k < 3; ++k) data[at + k] = shade[k];
    data[at + 3] = shade[3] * Math.min(1, Math.sqrt(count)); // a share of a line is faint
  }
  const canvas = new OffscreenCanvas(columns, height);
  canvas.getContext("2d").putImageData(image, 0, 0);
  return canvas;
}

function paint_quartiles(pen, axes, rows) {
  for (const { x, ys } of axes) {
    const quartiles = quartiles_of(ys, rows);
    if (!quartiles) continue;
    const [upper, median, lower] = quartiles;
    for (const [ink, spare] of [
      ["card", 1.5],
      ["ink", 0],
    ]) {
      pen.fillStyle = colour(ink);
      pen.fillRect(x - 2 - spare, upper - spare, 4 + 2 * spare, lower - upper + 2 * spare);
      pen.fillRect(x - 7 - spare, median - 1 - spare, 14 + 2 * spare, 2 + 2 * spare);
    }
  }
}

/**
 * Paints rows along the axes, whose places are x and ys. `quiet`: behind the others. With `ink`
 * they are lines of that colour and width.
 */
export function paint_rows(pen, axes, rows, { height, quiet, ink, wide = 1 }) {
  if (rows.length === 0 || axes.length === 0) return;
  pen.save();
  if (ink || rows.length <= kMostLines) {
    pen.strokeStyle = colour(ink ?? (quiet ? "ink-soft" : "accent"));
    pen.lineWidth = wide;
    pen.lineJoin = "round";
    pen.globalAlpha = ink ? 1 : quiet ? 0.08 : rows.length > 100 ? 0.35 : 0.6;
    paint_lines(pen, axes, rows);
  } else {
    const density = line_density(axes, rows, { height, cell: kCell_px });
    const { columns, height: cells } = density;
    pen.drawImage(picture_of(density, quiet), axes[0].x, 0, kCell_px * columns, kCell_px * cells);
    if (!quiet) paint_quartiles(pen, axes, rows);
  }
  pen.restore();
}
