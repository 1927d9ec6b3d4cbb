// Draws the folded sheet with three.js.
import {
  AmbientLight,
  BackSide,
  BufferAttribute,
  BufferGeometry,
  DirectionalLight,
  FrontSide,
  Group,
  Mesh,
  MeshLambertMaterial,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { colour } from "./theme.js";

const kSides = [
  [FrontSide, "panel-front"],
  [BackSide, "panel-back"],
];

/** Both sides of the panels, which share their corners' places. */
function panel_meshes(corners) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(corners.length * 18), 3));
  return kSides.map(([side, name]) => {
    const material = new MeshLambertMaterial({
      side,
      flatShading: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    });
    const mesh = new Mesh(geometry, material);
    mesh.userData.colour = name;
    mesh.frustumCulled = false;
    return mesh;
  });
}

function line_mesh({ pairs, width, dashed, dash, on_top }) {
  const geometry = new LineSegmentsGeometry();
  geometry.setPositions(new Float32Array(pairs.length * 6));
  if (dashed) new LineSegments2(geometry).computeLineDistances();
  const material = new LineMaterial({
    linewidth: width,
    depthTest: !on_top,
    depthWrite: !on_top,
    ...(dashed ? { dashed: true, dashSize: dash, gapSize: dash * 0.75 } : {}),
  });
  const mesh = new LineSegments2(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = on_top ? 2 : 1;
  return mesh;
}

/** Each panel is two triangles. */
function move_panels({ corners, geometry }, points) {
  const positions = geometry.attributes.position;
  corners.forEach(([a, b, c, d], i) =>
    [a, b, c, a, c, d].forEach((k, n) =>
      positions.array.set(points.subarray(3 * k, 3 * k + 3), 18 * i + 3 * n),
    ),
  );
  positions.needsUpdate = true;
}

function move_line({ part, mesh }, points) {
  const buffer = mesh.geometry.attributes.instanceStart.data;
  part.pairs.forEach(([a, b], i) => {
    buffer.array.set(points.subarray(3 * a, 3 * a + 3), 6 * i);
    buffer.array.set(points.subarray(3 * b, 3 * b + 3), 6 * i + 3);
  });
  buffer.needsUpdate = true;
  mesh.visible = !part.hidden;
  if (!part.dashed) return;
  const distances = mesh.geometry.attributes.instanceDistanceStart.data;
  part.pairs.forEach(([a, b], i) => {
    const length = Math.hypot(...[0, 1, 2].map((x) => points[3 * a + x] - points[3 * b + x]));
    distances.array.set([0, length], 2 * i);
  });
  distances.needsUpdate = true;
}

class WebglPen {
  #renderer;
  #scene = new Scene();
  #lamp = new DirectionalLight(0xffffff, 1.9);
  #group = null;
  #panels = null;
  #lines = [];

  constructor(canvas) {
    this.#renderer = new WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: true,
    });
    this.#scene.add(new AmbientLight(0xffffff, 1.7), this.#lamp);
  }

  load(corners, parts) {
    this.#unload();
    const panels = panel_meshes(corners);
    this.#panels = { corners, geometry: panels[0].geometry };
    this.#lines = parts
      .filter((part) => part.pairs.length > 0)
      .map((part) => ({ part, mesh: line_mesh(part) }));
    this.#group = new Group().add(...panels, ...this.#lines.map(({ mesh }) => mesh));
    this.#scene.add(this.#group);
  }

  recolour() {
    this.#group?.children.forEach(
      (mesh) => mesh.userData.colour && mesh.material.color.set(colour(mesh.userData.colour)),
    );
    for (const { part, mesh } of this.#lines) mesh.material.color.set(colour(part.colour));
  }

  resize(width, height) {
    this.#renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
    this.#renderer.setSize(width, height, false);
  }

  draw(points, camera) {
    if (!this.#group) return;
    move_panels(this.#panels, points);
    for (const line of this.#lines) move_line(line, points);
    const above = new Vector3(0, 0, camera.position.length() * 0.6);
    this.#lamp.position.copy(camera.position).add(above);
    this.#renderer.render(this.#scene, camera);
  }

  #unload() {
    if (!this.#group) return;
    this.#scene.remove(this.#group);
    this.#group.traverse((node) => {
      node.geometry?.dispose();
      node.material?.dispose();
    });
  }
}

/** Panels by their `corners`; `parts` are lines: { pairs, width, colour, dashed, on_top }. */
export const webgl_pen = (canvas) => new WebglPen(canvas);
