// Makes a drawing of the page a standalone file, with its styles and its legend.
import { h } from "./format.js";
import { text_width } from "./text_size.js";

const kStyles = [
  ...["fill", "fill-opacity", "stroke", "stroke-width", "stroke-opacity", "stroke-dasharray"],
  ...["stroke-linecap", "stroke-linejoin", "opacity", "font-size", "font-weight", "font-family"],
  ...["text-anchor", "dominant-baseline", "paint-order", "vector-effect"],
];
const kInitial = {
  "fill-opacity": "1",
  "stroke-opacity": "1",
  "stroke-dasharray": "none",
  "stroke-linecap": "butt",
  "stroke-linejoin": "miter",
  opacity: "1",
  "paint-order": "normal",
  "vector-effect": "none",
  "dominant-baseline": "auto",
};
const kPng = 2; // pixels of the file for each of the page
const kKey_px = 22;

const pixel = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
const known = new Map();

/** A colour as rgba, which every program reads. */
function plain_colour(value) {
  if (!/^(color|oklab|oklch|lab|lch)\(/.test(value)) return value;
  if (!known.has(value)) {
    pixel.clearRect(0, 0, 1, 1);
    pixel.fillStyle = value;
    pixel.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = pixel.getImageData(0, 0, 1, 1).data;
    known.set(value, `rgba(${r}, ${g}, ${b}, ${(a / 255).toFixed(3)})`);
  }
  return known.get(value);
}

function write_styles(from, to) {
  if (from.dataset.styled !== undefined) return; // its attributes are complete
  const style = getComputedStyle(from);
  if (style.display === "none" || style.visibility === "hidden") return to.remove();
  const text = kStyles
    .map((name) => [name, plain_colour(style.getPropertyValue(name))])
    .filter(([name, value]) => value && value !== kInitial[name])
    .map(([name, value]) => `${name}:${value.replaceAll('"', "'")}`)
    .join(";");
  const copies = [...to.children];
  [...from.children].forEach((child, i) => write_styles(child, copies[i]));
  for (const name of kStyles) to.removeAttribute(name);
  to.setAttribute("style", text);
  to.removeAttribute("class");
}

/** Appends the key's entries below the drawing; returns their height. */
function append_key(svg, entries, width, top) {
  let x = 8,
    y = top;
  for (const entry of entries) {
    const words = entry.textContent,
      wide = 46 + text_width(words, 13) + 14;
    if (x > 8 && x + wide > width) [x, y] = [8, y + kKey_px];
    const patch = entry.querySelector("i"),
      stroke = entry.querySelector("svg");
    if (patch) {
      const fill = plain_colour(getComputedStyle(patch).backgroundColor);
      svg.append(h("svg:rect", { x, y: y + 5, width: 12, height: 12, rx: 3, fill }));
    } else if (stroke) {
      const copy = stroke.firstElementChild.cloneNode(true);
      write_styles(stroke.firstElementChild, copy);
      copy.setAttribute("transform", `translate(${x},${y + 7})`);
      svg.append(copy);
    }
    const ink = getComputedStyle(entry);
    const style = `font:13px ${ink.fontFamily.replaceAll('"', "'")};fill:${ink.color}`;
    svg.append(h("svg:text", { x: x + (patch ? 18 : 40), y: y + 15, style }, words));
    x += wide - (patch ? 22 : 0);
  }
  return entries.length ? y + kKey_px - top + 6 : 0;
}

/** A standalone copy on its card's background; `key`: the elements of its legend. */
export function standalone_svg(drawing, key = []) {
  const { width, height } = drawing.getBoundingClientRect();
  const copy = drawing.cloneNode(true);
  write_styles(drawing, copy);
  copy.querySelectorAll("style").forEach((node) => node.remove());
  if (!copy.hasAttribute("viewBox")) copy.setAttribute("viewBox", `0 0 ${width} ${height}`);
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  const whole = h("svg:svg", { xmlns: "http://www.w3.org/2000/svg", width });
  const ground = h("svg:rect", {
    width,
    fill: getComputedStyle(drawing).getPropertyValue("--card"),
  });
  whole.append(ground, copy);
  const tall = Math.ceil(height + append_key(whole, [...key], width, height + 6));
  whole.setAttribute("height", tall);
  whole.setAttribute("viewBox", `0 0 ${width} ${tall}`);
  ground.setAttribute("height", tall);
  return whole;
}

export async function png_of(svg) {
  const text = new XMLSerializer().serializeToString(svg);
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([text], { type: "image/svg+xml" }));
  await image.decode();
  const canvas = h("canvas", {
    width: Math.round(kPng * svg.getAttribute("width")),
    height: Math.round(kPng * svg.getAttribute("height")),
  });
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}
