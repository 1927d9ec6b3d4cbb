// Shows the folding sheet in space: by WebGL where it is available, else on a 2-D canvas from back
// to front, with the same camera and controls.
import { Vector3 } from "three";
import { first_sample } from "./data.js";
import { folding_files } from "./folding_files.js";
import { h } from "./format.js";
import { PanelPaint } from "./panel_paint.js";
import { painter_pen } from "./painter_pen.js";
import { file_stem } from "./page_kind.js";
import { panel_size_mm } from "./sheet.js";
import { distance_from, is_within } from "./pointing.js";
import { SheetCamera } from "./sheet_camera.js";
import { kinds_of_springs, share_of_force } from "./spring_forces.js";
import { target_grid } from "./target_grid.js";
import { on_theme } from "./theme.js";
import { VertexLabels } from "./vertex_labels.js";
import { webgl_pen } from "./webgl_pen.js";

const kReach_px = 9,
  kUsualThickness = 0.0125; // of a panel's shorter side

const kTones = "Light: the side that the crease pattern shows. ";
const kHelp = "Drag to rotate, then the wheel zooms. Keys: arrows, + and −, 0.";

/** Height of the picture by its card's width, px: title, sheet and slider are on one screen. */
const folding_height = (width) =>
  Math.round(Math.min(0.9 * width, Math.max(430, Math.min(0.62 * width, 620))));

function radius_of(values) {
  let most = 0;
  for (let i = 0; i < values.length; i += 3)
    most = Math.max(most, Math.hypot(values[i], values[i + 1], values[i + 2]));
  return most || 1;
}

const pairs_of = (list) => list.map(({ from_vertex, to_vertex }) => [from_vertex, to_vertex]);

/** Pictures drawn since the page was opened. */
export const pictures = { count: 0 };

class FoldingView {
  #report;
  #state;
  #box;
  #caption;
  #help;
  #paint;
  #labels;
  #canvas = h("canvas", {
    tabindex: 0,
    role: "application",
    "aria-label":
      "The folding sheet in space. Keys: arrows rotate, plus and minus zoom, 0 shows the whole sheet.",
  });
  #pen;
  camera;
  #decoded = null;
  #detail = null;
  #force_share = null; // see share_of_force
  #target = null; // see target_grid
  #radius = 1;
  #marked = null;
  #points = null;
  #moves = false;
  #shown = 0; // sample at or before the shown place
  #width = 0;
  #is_seen = true;
  #is_recorded = false;

  /** `camera`: of another picture, beside which this one is. */
  constructor(box, caption, report, state, camera = new SheetCamera()) {
    [this.#report, this.#state, this.#box, this.camera] = [report, state, box, camera];
    this.#canvas.dataset.testid = `${box.id}-canvas`;
    try {
      this.#pen = webgl_pen(this.#canvas);
    } catch {
      this.#canvas = this.#canvas.cloneNode(); // nothing else is drawn on one of a lost context
      this.#pen = painter_pen(this.#canvas);
    }
    box.append(this.#canvas);
    this.#paint = new PanelPaint(box, report.sheet, () => this.#repaint());
    this.#labels = new VertexLabels(box, report.sheet, () => this.draw());
    box.append(
      h(
        "div",
        { class: "view-buttons" },
        this.#paint.button,
        this.#labels.button,
        this.#buttons(),
        this.#files(),
      ),
    );
    this.#caption = caption;
    this.#help =
      kHelp +
      (this.#pen.has_solids
        ? ""
        : " This browser has no WebGL: a simpler drawing, panels from back to front.");
    camera.attach(this.#canvas, () => this.draw());
    this.#listen();
    new ResizeObserver(([entry]) => this.#resize(Math.floor(entry.contentRect.width))).observe(box);
    new IntersectionObserver(([entry]) => {
      this.#is_seen = entry.isIntersecting;
      this.draw();
    }).observe(this.#canvas);
    const draw_anew = () => {
      this.#pen.recolour();
      this.#repaint();
    };
    on_theme(draw_anew);
    this.#canvas.addEventListener("webglcontextrestored", draw_anew);
  }

  load(detail, decoded) {
    const before = this.#radius;
    [this.#detail, this.#decoded, this.#points] = [detail, decoded, null];
    this.#radius = radius_of(this.#flat());
    this.#force_share = share_of_force(this.#report, decoded);
    this.#paint.load(detail);
    this.#target = target_grid(detail.target, decoded.vertex_count);
    this.#pen.load({
      panels: this.#report.sheet.panels,
      parts: this.#parts(),
      solids: this.#solids(),
      flat: this.#flat(),
      radius: this.#radius,
      ground_mm: this.#ground_mm(),
    });
    this.#pen.recolour();
    this.#repaint();
    if (before !== this.#radius && this.#width) this.whole();
    this.pose(null);
  }

  /**
   * Shows a place among the samples; null: that of the state, where the sheet rests. Between two
   * samples the vertices are interpolated linearly.
   */
  pose(at) {
    if (!this.#decoded) return;
    const place = at ?? this.#state.get("sample");
    this.#moves = at !== null && !Number.isInteger(at);
    const { vertex_count, vertices_mm, pilot_deg } = this.#decoded,
      count = 3 * vertex_count,
      sample = Math.floor(place),
      part = place - sample,
      before = vertices_mm.subarray(count * sample, count * (sample + 1));
    this.#points = new Float32Array(count + this.#target.points.length);
    this.#points.set(before);
    this.#points.set(this.#target.points, count);
    if (part > 0) {
      const after = vertices_mm.subarray(count * (sample + 1), count * (sample + 2));
      after.forEach((value, i) => (this.#points[i] += part * (value - before[i])));
    }
    this.#paint.pose(pilot_deg[sample]);
    this.#shown = sample;
    this.draw();
  }

  mark(d) {
    if (!this.#marked) return;
    this.#marked.hidden = d === null;
    if (d !== null) this.#marked.pairs[0] = pairs_of([this.#report.diagonals[d]])[0];
    this.draw();
  }

  draw() {
    if (!this.#points || !(this.#is_seen || this.#is_recorded)) return;
    if (pictures.count++ === 0) performance.mark("first-picture");
    const share = (d) => this.#force_share(this.#shown, d),
      largest = () => Math.max(0, ...this.#report.diagonals.map((_, d) => share(d)));
    const force_share = (d) => (d === null ? largest() : share(d));
    this.#pen.draw(this.#points, this.camera.camera, force_share, this.#moves);
    this.#labels.move((v) => this.#place(v));
  }

  whole() {
    this.camera.whole(this.#flat());
  }

  #repaint() {
    const tint = this.#paint.tint();
    this.#caption.textContent = (tint.caption ?? kTones) + this.#help;
    this.#pen.tint(tint);
    this.draw();
  }

  #buttons() {
    const fit = () => this.camera.fit(this.#points.subarray(0, this.#flat().length));
    return [
      ["Whole sheet", () => this.whole(), "Oblique view at the scale of the flat sheet"],
      ["Fit", fit, "View filled with the present pose"],
      ["Top view", () => this.camera.top(this.#flat()), "View of the crease pattern"],
    ].map(([words, onclick, title]) => h("button", { type: "button", title, onclick }, words));
  }

  #files() {
    const state = this.#state;
    return folding_files({
      pen: this.#pen,
      camera: this.camera.camera,
      canvas: this.#canvas,
      record: (on) => {
        this.#is_recorded = on;
        this.draw();
      },
      stem: () => this.#stem(),
      pose_stem: () => `${this.#stem()}-folded-${this.#decoded.pilot_deg[state.get("sample")]}deg`,
      range: () => {
        const decoded = this.#decoded;
        return {
          first: first_sample(this.#detail, decoded),
          pose: (place) => this.pose(place),
          goes_on: () => this.#decoded === decoded,
          pause: () => state.set("playing", false),
        };
      },
    });
  }

  #stem() {
    return file_stem(this.#report, this.#detail.draw);
  }

  #listen() {
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

  #flat() {
    return this.#decoded.vertices_mm.subarray(0, 3 * this.#decoded.vertex_count);
  }

  #thickness_mm() {
    return this.#detail.let_go?.thickness_mm ?? kUsualThickness * panel_size_mm(this.#report.sheet);
  }

  #solids() {
    const { sheet, actuators } = this.#report;
    return {
      springs: kinds_of_springs(this.#report, this.#decoded, (has_spring) => has_spring),
      holes: actuators.fill?.kind === "plate" ? sheet.holes.map(({ corners }) => corners) : [],
      balls: sheet.ball_joints,
      panel_mm: panel_size_mm(sheet),
      thickness_mm: this.#thickness_mm(),
    };
  }

  /** A height below the whole deployment. */
  #ground_mm() {
    const { vertices_mm, vertex_count } = this.#decoded,
      last = 3 * vertex_count * (first_sample(this.#detail, this.#decoded) + 1);
    let least = 0;
    for (let i = 2; i < last; i += 3) least = Math.min(least, vertices_mm[i]);
    return least - this.#thickness_mm();
  }

  /** Place of a vertex in the canvas, px, and its depth. */
  #place(v) {
    const points = this.#points,
      corner = new Vector3(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
    corner.project(this.camera.camera);
    const { clientWidth, clientHeight } = this.#canvas;
    return [((corner.x + 1) / 2) * clientWidth, ((1 - corner.y) / 2) * clientHeight, corner.z];
  }

  /** The places of all vertices, and that of the pointer. */
  #seen({ clientX, clientY }) {
    const frame = this.#canvas.getBoundingClientRect(),
      seen = Array.from({ length: this.#points.length / 3 }, (_, v) => this.#place(v));
    return { seen, pointer: [clientX - frame.left, clientY - frame.top] };
  }

  /** The number of the panel under the pointer that is nearest in the middle, or null. */
  #panel_under(event) {
    const { seen, pointer } = this.#seen(event);
    let best = null,
      least = Infinity;
    this.#report.sheet.panels.forEach((corners, panel) => {
      const outline = corners.map((k) => seen[k]),
        depth = outline.reduce((sum, [, , z]) => sum + z, 0);
      if (depth < least && is_within(pointer, outline)) [best, least] = [panel, depth];
    });
    return best;
  }

  /** The diagonal under the pointer, or null. */
  #nearest(event) {
    const { seen, pointer } = this.#seen(event);
    let best = null,
      least = kReach_px;
    this.#report.diagonals.forEach(({ from_vertex, to_vertex }, d) => {
      const away = distance_from(pointer, seen[from_vertex], seen[to_vertex]);
      if (away < least) [best, least] = [d, away];
    });
    return best;
  }

  #resize(width) {
    if (!width || width === this.#width) return;
    const first = this.#width === 0,
      height = folding_height(width);
    this.#width = width;
    this.#canvas.style.height = `${height}px`;
    this.#pen.resize(width, height);
    this.camera.aspect = width / height;
    if (first && this.#decoded) this.whole();
    this.draw();
  }

  /** Lines by kind; those of the picked diagonal lie on top. */
  #parts() {
    const { sheet } = this.#report;
    const creases = (kind) =>
      sheet.creases.filter((c) => c.assignment === kind).map(({ a, b }) => [a, b]);
    const thin = Math.max(0.45, Math.min(1, 8 / Math.sqrt(sheet.panels.length))); // for sheets of many panels
    this.#marked = { pairs: [[0, 0]], width: 6, colour: "pick", on_top: true, hidden: true };
    const { has_solids } = this.#pen;
    const is_line = (has_spring) => !(has_spring && has_solids);
    const diagonals = kinds_of_springs(this.#report, this.#decoded, is_line).map((part) => ({
      ...part,
      width: (has_solids ? 1.2 : 3) * thin,
      dashed: part.pushes,
      dash: (this.#radius / 34) * thin,
    }));
    return [
      { pairs: this.#target.pairs, width: 0.7, colour: "target" },
      ...(has_solids ? [] : [{ pairs: sheet.cuts, width: 1.4 * thin, colour: "edge" }]),
      { pairs: creases("mountain"), width: 1.8 * thin, colour: "mountain" },
      { pairs: creases("valley"), width: 1.8 * thin, colour: "valley" },
      ...diagonals,
      this.#paint.outline,
      this.#marked,
    ];
  }
}

export const make_folding_view = (...of) => new FoldingView(...of);
