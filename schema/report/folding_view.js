// Shows the folding sheet in space: by WebGL where it is available, else on a 2-D canvas from back
// to front, with the same camera and controls.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { clamp, h } from "./format.js";
import { PanelPaint } from "./panel_paint.js";
import { painter_pen } from "./painter_pen.js";
import { view_height } from "./sheet.js";
import { target_grid } from "./target_grid.js";
import { on_theme } from "./theme.js";
import { webgl_pen } from "./webgl_pen.js";

const kFov_deg = 30,
  kReach_px = 9;
const kFilled = 0.96; // share of the view that a fitted sheet takes

function has_webgl() {
  try {
    return Boolean(document.createElement("canvas").getContext("webgl2"));
  } catch {
    return false;
  }
}

const kTones = "Light: the side that the crease pattern shows. ";
const kHelp = "Drag to rotate, then the wheel zooms. Keys: arrows, + and −, 0.";

const rad = (deg) => (deg * Math.PI) / 180;

function radius_of(values) {
  let most = 0;
  for (let i = 0; i < values.length; i += 3)
    most = Math.max(most, Math.hypot(values[i], values[i + 1], values[i + 2]));
  return most || 1;
}

/** Distance of a point from a segment, on the screen. */
function away_from([x, y], [x1, y1], [x2, y2]) {
  const along =
      ((x - x1) * (x2 - x1) + (y - y1) * (y2 - y1)) / ((x2 - x1) ** 2 + (y2 - y1) ** 2 || 1),
    t = clamp(along, 0, 1);
  return Math.hypot(x - x1 - t * (x2 - x1), y - y1 - t * (y2 - y1));
}

/** Returns whether a point lies within a convex outline. */
function is_within([x, y], outline) {
  const sides = outline.map(([x1, y1], i) => {
    const [x2, y2] = outline[(i + 1) % outline.length];
    return (x2 - x1) * (y - y1) - (y2 - y1) * (x - x1);
  });
  return sides.every((side) => side >= 0) || sides.every((side) => side <= 0);
}

const pairs_of = (list) => list.map(({ from_vertex, to_vertex }) => [from_vertex, to_vertex]);

class FoldingView {
  #report;
  #state;
  #box;
  #caption;
  #help;
  #paint;
  #canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "data-testid": "folding-canvas",
    "aria-label":
      "The folding sheet in space. Keys: arrows rotate, plus and minus zoom, 0 shows the whole sheet.",
  });
  #pen;
  #camera = new PerspectiveCamera(kFov_deg, 1, 1, 1e6);
  #controls;
  #decoded = null;
  #target = null; // see target_grid
  #radius = 1;
  #marked = null;
  #points = null;
  #width = 0;

  constructor(box, caption, report, state) {
    [this.#report, this.#state, this.#box] = [report, state, box];
    box.append(this.#canvas);
    this.#paint = new PanelPaint(box, report.sheet, () => this.#repaint());
    box.append(h("div", { class: "view-buttons" }, this.#paint.button, this.#buttons()));
    const webgl = has_webgl();
    this.#pen = webgl ? webgl_pen(this.#canvas) : painter_pen(this.#canvas);
    this.#caption = caption;
    this.#help =
      kHelp +
      (webgl ? "" : " This browser has no WebGL: a simpler drawing, panels from back to front.");
    this.#set_up_controls();
    this.#listen();
    new ResizeObserver(([entry]) => this.#resize(Math.floor(entry.contentRect.width))).observe(box);
    on_theme(() => {
      this.#pen.recolour();
      this.#repaint();
    });
  }

  load(detail, decoded) {
    const before = this.#radius;
    this.#decoded = decoded;
    this.#radius = radius_of(this.#flat());
    this.#paint.load(detail);
    this.#target = target_grid(detail.target, decoded.vertex_count);
    this.#pen.load(this.#report.sheet.panels, this.#parts());
    this.#pen.recolour();
    this.#repaint();
    this.pose(this.#state.get("sample"));
    if (before !== this.#radius && this.#width) this.#whole();
  }

  pose(sample) {
    if (!this.#decoded) return;
    const { vertex_count, vertices_mm, pilot_deg } = this.#decoded;
    const sheet = vertices_mm.subarray(3 * sample * vertex_count, 3 * (sample + 1) * vertex_count);
    this.#points = new Float32Array(sheet.length + this.#target.points.length);
    this.#points.set(sheet);
    this.#points.set(this.#target.points, sheet.length);
    this.#paint.pose(pilot_deg[sample]);
    this.draw();
  }

  mark(d) {
    if (!this.#marked) return;
    this.#marked.hidden = d === null;
    if (d !== null) this.#marked.pairs[0] = pairs_of([this.#report.diagonals[d]])[0];
    this.draw();
  }

  draw() {
    if (!this.#points) return;
    this.#camera.updateMatrixWorld();
    this.#pen.draw(this.#points, this.#camera);
  }

  #repaint() {
    const tint = this.#paint.tint();
    this.#caption.textContent = (tint.caption ?? kTones) + this.#help;
    this.#pen.tint(tint);
    this.draw();
  }

  #buttons() {
    return [
      ["Whole sheet", () => this.#whole(), "Oblique view at the scale of the flat sheet"],
      ["Fit", () => this.#fit(), "View filled with the present pose"],
      ["Top view", () => this.#look(-90, 89.9, this.#flat()), "View of the crease pattern"],
    ].map(([words, onclick, title]) => h("button", { type: "button", title, onclick }, words));
  }

  #set_up_controls() {
    this.#camera.up.set(0, 0, 1);
    this.#controls = new OrbitControls(this.#camera, this.#canvas);
    this.#controls.zoomSpeed = 0.6;
    // The wheel scrolls the page until the sheet is clicked.
    this.#controls.enableZoom = false;
    this.#canvas.addEventListener("focus", () => (this.#controls.enableZoom = true));
    this.#canvas.addEventListener("blur", () => (this.#controls.enableZoom = false));
    this.#controls.addEventListener("change", () => this.draw());
  }

  #listen() {
    this.#canvas.addEventListener("keydown", (event) => this.#key(event));
    this.#canvas.addEventListener("pointermove", (event) => {
      if (!this.#decoded || event.buttons) return;
      this.#state.set("diagonal", this.#nearest(event));
      this.#paint.say(this.#panel_under(event), event, this.#box);
    });
    this.#canvas.addEventListener("pointerleave", (event) => {
      this.#state.set("diagonal", null);
      this.#paint.say(null, event, this.#box);
    });
  }

  #key(event) {
    const action = {
      ArrowLeft: () => this.#turn(-0.12, 0, 1),
      ArrowRight: () => this.#turn(0.12, 0, 1),
      ArrowUp: () => this.#turn(0, 0.1, 1),
      ArrowDown: () => this.#turn(0, -0.1, 1),
      "+": () => this.#turn(0, 0, 0.9),
      "=": () => this.#turn(0, 0, 0.9),
      "-": () => this.#turn(0, 0, 1 / 0.9),
      0: () => this.#whole(),
      f: () => this.#fit(),
    }[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  }

  // Views all points from a direction, as near as they fit.
  #look(azimuth_deg, elevation_deg, values) {
    const [az, el] = [rad(azimuth_deg), rad(elevation_deg)],
      camera = this.#camera;
    const towards = new Vector3(
      Math.cos(el) * Math.cos(az),
      Math.cos(el) * Math.sin(az),
      Math.sin(el),
    );
    const right = new Vector3(-Math.sin(az), Math.cos(az), 0),
      up = towards.clone().cross(right),
      point = new Vector3();
    const slope = kFilled * Math.tan(rad(kFov_deg) / 2);
    let distance = 1;
    for (let i = 0; i < values.length; i += 3) {
      point.set(values[i], values[i + 1], values[i + 2]);
      distance = Math.max(
        distance,
        point.dot(towards) +
          Math.max(Math.abs(point.dot(right)) / camera.aspect, Math.abs(point.dot(up))) / slope,
      );
    }
    this.#controls.target.set(0, 0, 0);
    camera.position.copy(towards).multiplyScalar(distance);
    camera.near = distance / 50;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    this.#controls.update();
    this.draw();
  }

  #angles() {
    const away = this.#camera.position.clone().sub(this.#controls.target),
      distance = away.length();
    return {
      azimuth: Math.atan2(away.y, away.x),
      elevation: Math.asin(away.z / distance),
      distance,
    };
  }

  #turn(azimuth, elevation, factor) {
    const now = this.#angles(),
      el = clamp(now.elevation + elevation, -1.5, 1.5),
      az = now.azimuth + azimuth;
    this.#camera.position
      .set(Math.cos(el) * Math.cos(az), Math.cos(el) * Math.sin(az), Math.sin(el))
      .multiplyScalar(now.distance * factor)
      .add(this.#controls.target);
    this.#controls.update();
    this.draw();
  }

  #flat() {
    return this.#decoded.vertices_mm.subarray(0, 3 * this.#decoded.vertex_count);
  }

  #whole() {
    this.#look(-62, 38, this.#flat());
  }

  #fit() {
    const { azimuth, elevation } = this.#angles();
    this.#look(azimuth / rad(1), elevation / rad(1), this.#points.subarray(0, this.#flat().length));
  }

  /** Position of each vertex in the window, px, and its depth. */
  #seen() {
    const frame = this.#canvas.getBoundingClientRect(),
      corner = new Vector3(),
      points = this.#points;
    return Array.from({ length: points.length / 3 }, (_, k) => {
      corner.set(points[3 * k], points[3 * k + 1], points[3 * k + 2]).project(this.#camera);
      return [
        frame.left + ((corner.x + 1) / 2) * frame.width,
        frame.top + ((1 - corner.y) / 2) * frame.height,
        corner.z,
      ];
    });
  }

  /** The number of the panel under the pointer that is nearest in the middle, or null. */
  #panel_under({ clientX, clientY }) {
    const seen = this.#seen();
    let best = null,
      least = Infinity;
    this.#report.sheet.panels.forEach((corners, panel) => {
      const outline = corners.map((k) => seen[k]),
        depth = outline.reduce((sum, [, , z]) => sum + z, 0);
      if (depth < least && is_within([clientX, clientY], outline)) [best, least] = [panel, depth];
    });
    return best;
  }

  /** The diagonal under the pointer, or null. */
  #nearest(event) {
    const seen = this.#seen();
    let best = null,
      least = kReach_px;
    this.#report.diagonals.forEach(({ from_vertex, to_vertex }, d) => {
      const away = away_from([event.clientX, event.clientY], seen[from_vertex], seen[to_vertex]);
      if (away < least) [best, least] = [d, away];
    });
    return best;
  }

  #resize(width) {
    if (!width || width === this.#width) return;
    const first = this.#width === 0,
      height = view_height(width);
    this.#width = width;
    this.#canvas.style.height = `${height}px`;
    this.#pen.resize(width, height);
    this.#camera.aspect = width / height;
    this.#camera.updateProjectionMatrix();
    if (first && this.#decoded) this.#whole();
    this.draw();
  }

  /** Lines by kind; those of the picked diagonal lie on top. */
  #parts() {
    const { sheet, diagonals } = this.#report,
      { grows } = this.#decoded;
    const creases = (kind) =>
      sheet.creases.filter((c) => c.assignment === kind).map(({ a, b }) => [a, b]);
    const thin = Math.max(0.45, Math.min(1, 8 / Math.sqrt(sheet.panels.length))); // for sheets of many panels
    this.#marked = { pairs: [[0, 0]], width: 6, colour: "pick", on_top: true, hidden: true };
    return [
      { pairs: this.#target.pairs, width: 0.7, colour: "target" },
      { pairs: sheet.cuts, width: 1.4 * thin, colour: "edge" },
      { pairs: creases("mountain"), width: 1.8 * thin, colour: "mountain" },
      { pairs: creases("valley"), width: 1.8 * thin, colour: "valley" },
      { pairs: pairs_of(diagonals.filter((_, d) => grows[d])), width: 3 * thin, colour: "grows" },
      {
        pairs: pairs_of(diagonals.filter((_, d) => !grows[d])),
        width: 3 * thin,
        colour: "shrinks",
        dashed: true,
        dash: (this.#radius / 34) * thin,
      },
      this.#paint.outline,
      this.#marked,
    ];
  }
}

export const make_folding_view = (box, caption, report, state) =>
  new FoldingView(box, caption, report, state);
