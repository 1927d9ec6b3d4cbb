// Draws the folded sheet with three.js.
import {
  AmbientLight,
  BackSide,
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  FrontSide,
  Group,
  Mesh,
  MeshBasicMaterial,
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

/** Meshes of both sides of the panels, which share their corners. */
function panel_meshes(corners) {
  const values = () => new BufferAttribute(new Float32Array(corners.length * 18), 3),
    position = values();
  return kSides.map(([side, name]) => {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", position);
    geometry.setAttribute("color", values());
    const options = {
      side,
      vertexColors: true,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 2,
    };
    const lit = new MeshLambertMaterial({ ...options, flatShading: true }),
      plain = new MeshBasicMaterial(options); // not shaded
    const mesh = new Mesh(geometry, lit);
    mesh.userData = { colour: name, lit, plain };
    mesh.frustumCulled = false;
    return mesh;
  });
}

/** Colours each panel's six corners; null: the side's colour. */
function colour_panels({ geometry, userData }, colours) {
  const { array } = geometry.attributes.color,
    side = colour(userData.colour),
    rgb = new Color();
  colours.forEach((panel, i) => {
    rgb.set(panel ?? side);
    for (let n = 0; n < 6; ++n) rgb.toArray(array, 18 * i + 3 * n);
  });
  geometry.attributes.color.needsUpdate = true;
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
function move_panels({ corners, meshes }, points) {
  const positions = meshes[0].geometry.attributes.position; // of both sides
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
  #tint = null;
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
    const meshes = panel_meshes(corners);
    this.#panels = { corners, meshes };
    this.#lines = parts
      .filter((part) => part.pairs.length > 0)
      .map((part) => ({ part, mesh: line_mesh(part) }));
    this.#group = new Group().add(...meshes, ...this.#lines.map(({ mesh }) => mesh));
    this.#scene.add(this.#group);
  }

  tint(tint) {
    this.#tint = tint;
    if (!this.#group) return;
    const { corners, meshes } = this.#panels,
      own = corners.map(() => null);
    for (const mesh of meshes) {
      colour_panels(mesh, tint?.colours ?? own);
      mesh.material = tint?.exact ? mesh.userData.plain : mesh.userData.lit;
    }
  }

  recolour() {
    if (!this.#group) return;
    this.tint(this.#tint);
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
      for (const material of [node.material, node.userData.lit, node.userData.plain])
        material?.dispose();
    });
  }
}

/**
 * Panels by their `corners`; `parts` are lines: { pairs, width, colour, dashed, on_top }. A tint is
 * { colours, exact }, see PanelPaint.
 */
export const webgl_pen = (canvas) => new WebglPen(canvas);
