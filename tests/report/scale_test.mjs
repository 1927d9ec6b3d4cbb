// The scales that panels and counts are coloured by, without a browser:
//   node scale_test.mjs SCHEMA/REPORT
// Their colours grow lighter or darker all the way, in both themes, and neighbours among nine are told
// apart by everyone: also where one kind of cones is missing (Machado, Oliveira & Fernandes 2009).
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [directory] = process.argv.slice(2);
const { colour_scale, light_of, oklab_of } = await import(
  pathToFileURL(resolve(join(directory, "colour_scale.js"))).href
);

const kSight = {
  all: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  "no long cones": [
    [0.152286, 1.052583, -0.204868],
    [0.114503, 0.786281, 0.099216],
    [-0.003882, -0.048116, 1.051998],
  ],
  "no middle cones": [
    [0.367322, 0.860646, -0.227968],
    [0.280085, 0.672501, 0.047413],
    [-0.01182, 0.04294, 0.968881],
  ],
  "no short cones": [
    [1.255528, -0.076749, -0.178779],
    [-0.078411, 0.930809, 0.147602],
    [0.004733, 0.691367, 0.3039],
  ],
};
const seen = (matrix, hex) => {
  const rgb = light_of(hex);
  return oklab_of(
    matrix.map((row) =>
      Math.max(
        0,
        row.reduce((sum, factor, i) => sum + factor * rgb[i], 0),
      ),
    ),
  );
};

// A scale through two stops is where they are at its ends, and grey in the middle of black and white.
assert.equal(colour_scale(["#000000", "#ffffff"])(0), "#000000");
assert.equal(colour_scale(["#000000", "#ffffff"])(2), "#ffffff");
assert.equal(colour_scale(["#000000", "#ffffff"])(0.5), "#636363", "lightness 0.5 in OKLab");
assert.equal(colour_scale(["#ff0000", "#00ff00", "#0000ff"])(0.5), "#00ff00");

const css = readFileSync(join(directory, "page.css"), "utf8"),
  [light, dark] = css.split(':root[data-theme="dark"]');
const kSteps = 8,
  kLeast = 0.035; // in OKLab; about twice what is just seen side by side
function check_scale(name, theme, text) {
  const stops = ["least", "middle", "most"].map(
      (stop) => new RegExp(`--${name}-${stop}: (#[0-9a-f]{6})`).exec(text)[1],
    ),
    scale = colour_scale(stops);
  const colours = Array.from({ length: kSteps + 1 }, (_, i) => scale(i / kSteps));
  for (const [sight, matrix] of Object.entries(kSight)) {
    const labs = colours.map((hex) => seen(matrix, hex));
    const way = Math.sign(labs.at(-1)[0] - labs[0][0]);
    assert.equal(
      way,
      theme === "light" ? -1 : 1,
      `${name}, ${theme}: the most stands out from the ground`,
    );
    labs.slice(1).forEach((lab, i) => {
      assert.ok(
        way * (lab[0] - labs[i][0]) > 0.02,
        `${name}, ${theme}, ${sight}: lightness at step ${i + 1}`,
      );
      const apart = Math.hypot(...lab.map((value, k) => value - labs[i][k]));
      assert.ok(
        apart > kLeast,
        `${name}, ${theme}, ${sight}: step ${i + 1} is ${apart.toFixed(3)} away`,
      );
    });
  }
}
for (const [theme, text] of Object.entries({ light, dark }))
  for (const name of ["stress", "count"]) check_scale(name, theme, text);
console.log("the scales' colours are told apart");
