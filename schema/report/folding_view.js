// The sheet folding in space. Drawn by WebGL where there is one, else by a painter on a 2-D canvas:
// the same camera and controls, panels from back to front.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { h } from "./format.js";
import { painter_pen } from "./painter_pen.js";
import { view_height } from "./sheet.js";
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

export function make_folding_view(box, caption, report, state) {
  const canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "data-testid": "folding-canvas",
    "aria-label":
      "The sheet folding in space. Arrow keys turn it, plus and minus zoom, 0 shows all of it again.",
  });
  const buttons = h("div", { class: "view-buttons" });
  box.append(canvas, buttons);
  const webgl = has_webgl();
  const pen = webgl ? webgl_pen(canvas) : painter_pen(canvas);
  const camera = new PerspectiveCamera(kFov_deg, 1, 1, 1e6);
  camera.up.set(0, 0, 1);
  const controls = new OrbitControls(camera, canvas);
  controls.zoomSpeed = 0.6;
  // The wheel scrolls the page, until the sheet was clicked on.
  controls.enableZoom = false;
  canvas.addEventListener("focus", () => (controls.enableZoom = true));
  canvas.addEventListener("blur", () => (controls.enableZoom = false));
  let decoded = null,
    radius = 1,
    marked = null,
    points = null;

  caption.textContent =
    `Two-toned: light is the side seen in the crease pattern. Drag to turn, then the wheel zooms; with the keyboard: arrows, + and −, 0.` +
    (webgl ? "" : " This browser has no WebGL: a simpler drawing, panels from back to front.");

  function radius_of(values) {
    let most = 0;
    for (let i = 0; i < values.length; i += 3)
      most = Math.max(most, Math.hypot(values[i], values[i + 1], values[i + 2]));
    return most || 1;
  }

  // From that direction, as near as all the points leave room.
  function look(azimuth_deg, elevation_deg, values) {
    const [az, el] = [azimuth_deg, elevation_deg].map((deg) => (deg * Math.PI) / 180);
    const towards = new Vector3(
      Math.cos(el) * Math.cos(az),
      Math.cos(el) * Math.sin(az),
      Math.sin(el),
    );
    const right = new Vector3(-Math.sin(az), Math.cos(az), 0),
      up = towards.clone().cross(right),
      point = new Vector3();
    const slope = kFilled * Math.tan((kFov_deg * Math.PI) / 360);
    let distance = 1;
    for (let i = 0; i < values.length; i += 3) {
      point.set(values[i], values[i + 1], values[i + 2]);
      distance = Math.max(
        distance,
        point.dot(towards) +
          Math.max(Math.abs(point.dot(right)) / camera.aspect, Math.abs(point.dot(up))) / slope,
      );
    }
    controls.target.set(0, 0, 0);
    camera.position.copy(towards).multiplyScalar(distance);
    camera.near = distance / 50;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    controls.update();
    draw();
  }

  function angles() {
    const away = camera.position.clone().sub(controls.target),
      distance = away.length();
    return {
      azimuth: Math.atan2(away.y, away.x),
      elevation: Math.asin(away.z / distance),
      distance,
    };
  }

  function turn(azimuth, elevation, factor) {
    const now = angles(),
      el = Math.max(-1.5, Math.min(1.5, now.elevation + elevation)),
      az = now.azimuth + azimuth;
    camera.position
      .set(Math.cos(el) * Math.cos(az), Math.cos(el) * Math.sin(az), Math.sin(el))
      .multiplyScalar(now.distance * factor)
      .add(controls.target);
    controls.update();
    draw();
  }

  const flat = () => decoded.vertices_mm.subarray(0, 3 * decoded.vertex_count);
  const whole = () => look(-62, 38, flat());
  const fit = () => {
    const { azimuth, elevation } = angles();
    look((azimuth * 180) / Math.PI, (elevation * 180) / Math.PI, points);
  };
  for (const [words, action, about] of [
    ["Whole sheet", whole, "The scale of the flat sheet, seen obliquely"],
    ["Fit", fit, "Fill the view with the present pose"],
    ["From above", () => look(-90, 89.9, flat()), "As the crease pattern is seen"],
  ]) {
    buttons.append(h("button", { type: "button", title: about, onclick: action }, words));
  }
  canvas.addEventListener("keydown", (event) => {
    const action = {
      ArrowLeft: () => turn(-0.12, 0, 1),
      ArrowRight: () => turn(0.12, 0, 1),
      ArrowUp: () => turn(0, 0.1, 1),
      ArrowDown: () => turn(0, -0.1, 1),
      "+": () => turn(0, 0, 0.9),
      "=": () => turn(0, 0, 0.9),
      "-": () => turn(0, 0, 1 / 0.9),
      0: whole,
      f: fit,
    }[event.key];
    if (!action || event.ctrlKey || event.metaKey) return;
    action();
    event.preventDefault();
  });

  function draw() {
    if (!points) return;
    camera.updateMatrixWorld();
    pen.draw(points, camera);
  }
  controls.addEventListener("change", draw);

  // The diagonal nearest to the pointer, on the screen.
  canvas.addEventListener("pointermove", (event) => {
    if (!decoded || event.buttons) return;
    const frame = canvas.getBoundingClientRect(),
      corner = new Vector3();
    const seen = (k) => {
      corner.set(points[3 * k], points[3 * k + 1], points[3 * k + 2]).project(camera);
      return [
        frame.left + ((corner.x + 1) / 2) * frame.width,
        frame.top + ((1 - corner.y) / 2) * frame.height,
      ];
    };
    let best = null,
      least = kReach_px;
    report.diagonals.forEach(({ from_vertex, to_vertex }, d) => {
      const [x1, y1] = seen(from_vertex),
        [x2, y2] = seen(to_vertex);
      const along = Math.max(
        0,
        Math.min(
          1,
          ((event.clientX - x1) * (x2 - x1) + (event.clientY - y1) * (y2 - y1)) /
            ((x2 - x1) ** 2 + (y2 - y1) ** 2 || 1),
        ),
      );
      const away = Math.hypot(
        event.clientX - x1 - along * (x2 - x1),
        event.clientY - y1 - along * (y2 - y1),
      );
      if (away < least) [best, least] = [d, away];
    });
    state.set("diagonal", best);
  });
  canvas.addEventListener("pointerleave", () => state.set("diagonal", null));

  let width = 0,
    height = 0;
  new ResizeObserver(([entry]) => {
    const now = Math.floor(entry.contentRect.width);
    if (!now || now === width) return;
    const first = width === 0;
    width = now;
    height = view_height(width);
    canvas.style.height = `${height}px`;
    pen.resize(width, height);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    if (first && decoded) whole();
    draw();
  }).observe(box);
  on_theme(() => {
    pen.recolour();
    draw();
  });

  const pairs_of = (list) => list.map(({ from_vertex, to_vertex }) => [from_vertex, to_vertex]);
  return {
    load(decoded_) {
      const before = radius;
      decoded = decoded_;
      radius = radius_of(flat());
      const { sheet, diagonals } = report,
        creases = (kind) =>
          sheet.creases.filter((c) => c.assignment === kind).map(({ a, b }) => [a, b]);
      const thin = Math.max(0.45, Math.min(1, 8 / Math.sqrt(sheet.panels.length))); // for sheets of many panels
      marked = { pairs: [[0, 0]], width: 6, colour: "pick", on_top: true, hidden: true };
      pen.load(sheet.panels, [
        { pairs: sheet.cuts, width: 1.4 * thin, colour: "edge" },
        { pairs: creases("mountain"), width: 1.8 * thin, colour: "mountain" },
        { pairs: creases("valley"), width: 1.8 * thin, colour: "valley" },
        {
          pairs: pairs_of(diagonals.filter((_, d) => decoded.grows[d])),
          width: 3 * thin,
          colour: "grows",
        },
        {
          pairs: pairs_of(diagonals.filter((_, d) => !decoded.grows[d])),
          width: 3 * thin,
          colour: "shrinks",
          dashed: true,
          dash: (radius / 34) * thin,
        },
        marked,
      ]);
      pen.recolour();
      this.pose(state.get("sample"));
      if (before !== radius && width) whole();
    },
    pose(sample) {
      if (!decoded) return;
      points = decoded.vertices_mm.subarray(
        3 * sample * decoded.vertex_count,
        3 * (sample + 1) * decoded.vertex_count,
      );
      draw();
    },
    mark(d) {
      if (!marked) return;
      marked.hidden = d === null;
      if (d !== null) marked.pairs[0] = pairs_of([report.diagonals[d]])[0];
      draw();
    },
    draw,
  };
}
