// Draws the folded sheet with three.js: plates, springs and joints as bodies, with a shadow.
import {
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  PCFShadowMap,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  WebGLRenderer,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { PanelSolids } from "./panel_solids.js";
import { bodies_of, distance } from "./spring_bodies.js";
import { colour } from "./theme.js";

const kShadow_px = 1024,
  kMostPanels = 100; // larger sheets are coarser yet while they move

let software = null; // not yet known

/** Returns whether WebGL is drawn without a graphics card. */
function is_software() {
  if (software !== null) return software;
  const gl = document.createElement("canvas").getContext("webgl2"),
    info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "";
  return (software = /swiftshader|llvmpipe|software/i.test(name));
}

function line_mesh({ pairs, width, dashed, dash, on_top }) {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(new Float32Array(pairs.length * 6));
  if (dashed) new LineSegments2(geometry).computeLineDistances();
  const material = new LineMaterial({
    linewidth: width,
    depthTest: !on_top,
    depthWrite: !on_top,
    polygonOffset: true, // a crease is seen, though the plates' faces meet above it
    polygonOffsetFactor: 0,
    polygonOffsetUnits: -300,
    ...(dashed ? { dashed: true, dashSize: dash, gapSize: dash * 0.75 } : {}),
  });
  const mesh = new LineSegments2(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = on_top ? 2 : 1;
  return mesh;
}

function move_line({ part, mesh }, points) {
  mesh.visible = !part.hidden;
  if (part.hidden) return;
  const buffer = mesh.geometry.attributes.instanceStart.data;
  part.pairs.forEach(([a, b], i) => {
    buffer.array.set(points.subarray(3 * a, 3 * a + 3), 6 * i);
    buffer.array.set(points.subarray(3 * b, 3 * b + 3), 6 * i + 3);
  });
  buffer.needsUpdate = true;
  if (!part.dashed) return;
  const distances = mesh.geometry.attributes.instanceDistanceStart.data;
  part.pairs.forEach((pair, i) => distances.array.set([0, distance(points, pair)], 2 * i));
  distances.needsUpdate = true;
}

class WebglPen {
  has_solids = true;
  #renderer;
  #scene = new Scene();
  #sky = new HemisphereLight(0xffffff, 0x9a938c, 1.35);
  #lamp = new DirectionalLight(0xfff6e8, 2.3);
  #ground = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial());
  #group = null; // of the sheet
  #panels = null;
  #bodies = [];
  #lines = [];
  #drawn = null; // the points of the last picture
  // A moving sheet is coarser without a graphics card, and has no shadow; one at rest is finer.
  #is_software = is_software();
  #moves = false;
  #is_large = false;
  #size = [1, 1];

  constructor(canvas) {
    const context = canvas.getContext("webgl2", {
      antialias: !this.#is_software,
      preserveDrawingBuffer: true,
    });
    if (!context || context.isContextLost()) throw new Error("no WebGL");
    this.#renderer = new WebGLRenderer({ canvas, context });
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.shadowMap.type = PCFShadowMap;
    this.#renderer.shadowMap.autoUpdate = false;
    this.#lamp.castShadow = true;
    this.#lamp.shadow.mapSize.set(kShadow_px, kShadow_px);
    this.#lamp.shadow.radius = 3;
    this.#ground.receiveShadow = true;
    this.#scene.add(this.#sky, this.#lamp, this.#lamp.target, this.#ground);
  }

  /** `solids` see bodies_of; `ground_mm` is the height of what the shadow falls on. */
  load({ panels, parts, solids, flat, radius, ground_mm }) {
    this.#unload();
    this.#panels = new PanelSolids(panels, flat, solids.thickness_mm);
    this.#bodies = bodies_of(solids, flat);
    this.#is_large = panels.length > kMostPanels;
    this.#lines = parts
      .filter((part) => part.pairs.length > 0)
      .map((part) => ({ part, mesh: line_mesh(part) }));
    this.#group = new Group().add(
      this.#panels.mesh,
      ...this.#bodies.map(({ mesh }) => mesh),
      ...this.#lines.map(({ mesh }) => mesh),
    );
    this.#scene.add(this.#group);
    this.#light(radius, ground_mm, solids.thickness_mm);
    this.#set_pace(false);
  }

  tint({ colours, exact }) {
    this.#panels?.paint(colours, exact);
  }

  /** Takes the colours of the present theme; `tint` those of the panels. */
  recolour() {
    if (!this.#group) return;
    for (const { part, mesh } of this.#lines) mesh.material.color.set(colour(part.colour));
    const [shade, opacity] = colour("cast").split(/\s+/);
    this.#ground.material.color = new Color(shade);
    this.#ground.material.opacity = Number(opacity);
    this.#drawn = null;
  }

  resize(width, height) {
    this.#size = [width, height];
    const finest = this.#is_software ? 2 : devicePixelRatio || 1,
      coarse = this.#is_large ? 0.6 : 1;
    this.#renderer.setPixelRatio(this.#moves ? coarse : Math.min(2, finest));
    this.#renderer.setSize(width, height, false);
  }

  /** `force_share`: of each spring, the share of the largest force; `moves`: more follow at once. */
  draw(points, camera, force_share, moves) {
    if (!this.#group) return;
    if (this.#is_software && moves !== this.#moves) this.#set_pace(moves);
    if (points !== this.#drawn) {
      this.#panels.move(points);
      for (const body of this.#bodies) body.move(points, force_share);
      this.#renderer.shadowMap.needsUpdate = true;
      this.#drawn = points;
    }
    for (const line of this.#lines) move_line(line, points);
    this.#renderer.render(this.#scene, camera);
  }

  /** A canvas with the picture at another size, whose shape the camera has; then as before. */
  async picture(width, height, camera, save) {
    this.#set_pace(false);
    this.#renderer.setPixelRatio(width / this.#size[0]); // lines keep their share of the picture
    this.#renderer.setSize(this.#size[0], height / (width / this.#size[0]), false);
    this.#renderer.render(this.#scene, camera);
    const saved = await save(this.#renderer.domElement);
    this.resize(...this.#size);
    this.#renderer.render(this.#scene, camera);
    return saved;
  }

  /** The meshes of panels and bodies as they are now. */
  get solids() {
    this.#set_pace(false);
    return [this.#panels.mesh, ...this.#bodies.map(({ mesh }) => mesh)];
  }

  #set_pace(moves) {
    this.#moves = moves;
    this.#lamp.castShadow = this.#ground.visible = !moves;
    this.#panels.show_rims(!moves);
    for (const { mesh, is_small } of this.#bodies)
      mesh.visible = !(moves && is_small && this.#is_large);
    this.resize(...this.#size);
    this.#renderer.shadowMap.needsUpdate = true;
    this.#drawn = null;
  }

  #light(radius, ground_mm, thickness_mm) {
    const { camera } = this.#lamp.shadow;
    this.#lamp.position.set(-0.7 * radius, -1.1 * radius, 2.6 * radius);
    Object.assign(camera, { left: -radius, right: radius, bottom: -radius, top: radius });
    [camera.near, camera.far] = [0.5 * radius, 6 * radius];
    camera.updateProjectionMatrix();
    this.#lamp.shadow.normalBias = Math.max(thickness_mm / 2, radius / 200);
    this.#ground.position.set(0, 0, ground_mm);
    this.#ground.scale.setScalar(8 * radius);
  }

  #unload() {
    if (!this.#group) return;
    this.#scene.remove(this.#group);
    this.#group.traverse((node) => {
      node.geometry?.dispose();
      node.material?.dispose();
      node.dispose?.();
    });
    this.#panels.dispose();
  }
}

/** Throws where the canvas can have no context of WebGL. */
export const webgl_pen = (canvas) => new WebglPen(canvas);
