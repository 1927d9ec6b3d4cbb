// A colour scale through stops, interpolated in OKLab as CSS does, which is perceptually uniform.

const linear = (share) => (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
const encoded = (share) =>
  share <= 0.0031308 ? 12.92 * share : 1.055 * share ** (1 / 2.4) - 0.055;
const times = (matrix, vector) =>
  matrix.map((row) => row.reduce((sum, factor, i) => sum + factor * vector[i], 0));

// Björn Ottosson's: linear sRGB to cone responses, their cube roots to lightness and two axes.
const kCones = [
    [0.4122214708, 0.5363325363, 0.0514459929],
    [0.2119034982, 0.6806995451, 0.1073969566],
    [0.0883024619, 0.2817188376, 0.6299787005],
  ],
  kLab = [
    [0.2104542553, 0.793617785, -0.0040720468],
    [1.9779984951, -2.428592205, 0.4505937099],
    [0.0259040371, 0.7827717662, -0.808675766],
  ],
  kRoots = [
    [1, 0.3963377774, 0.2158037573],
    [1, -0.1055613458, -0.0638541728],
    [1, -0.0894841775, -1.291485548],
  ],
  kRgb = [
    [4.0767416621, -3.3077115913, 0.2309699292],
    [-1.2684380046, 2.6097574011, -0.3413193965],
    [-0.0041960863, -0.7034186147, 1.707614701],
  ];

/** "#rrggbb" as red, green and blue of linear light. */
export const light_of = (hex) =>
  [1, 3, 5].map((at) => linear(parseInt(hex.slice(at, at + 2), 16) / 255));

/** Lightness and the axes green to red and blue to yellow. */
export const oklab_of = (rgb) => times(kLab, times(kCones, rgb).map(Math.cbrt));

function hex_of(lab) {
  const rgb = times(
    kRgb,
    times(kRoots, lab).map((root) => root ** 3),
  );
  const byte = (share) => Math.round(255 * encoded(Math.max(0, Math.min(1, share))));
  return `#${rgb.map((share) => byte(share).toString(16).padStart(2, "0")).join("")}`;
}

/** The colour at a share, 0 to 1, of equidistant stops ("#rrggbb"). */
export function colour_scale(stops) {
  const labs = stops.map((stop) => oklab_of(light_of(stop))),
    last = labs.length - 1;
  return (share) => {
    const at = Math.max(0, Math.min(1, share)) * last,
      k = Math.min(last - 1, Math.floor(at));
    return hex_of(labs[k].map((from, i) => from + (at - k) * (labs[k + 1][i] - from)));
  };
}
