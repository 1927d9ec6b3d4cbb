// The rigid panels as plates with bevelled edges, in one mesh that moves with the vertices.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
} from "three";
import { colour } from "./theme.js";

const kGap = 0.25; // half the gap at a crease, of the thickness

/** The place k of a list of coordinates. */
const at = (values, k) => [values[3 * k], values[3 * k + 1], values[3 * k + 2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a) => {
  const length = Math.hypot(...a) || 1;
  return a.map((value) => value / length);
};

/** A panel's frame: its first corner, the direction of its first edge, and two across it. */
function frame_of(corners, points) {
  const origin = at(points, corners[0]),
    x = unit(minus(at(points, corners[1]), origin));
  const z = unit(cross(x, minus(at(points, corners[corners.length - 1]), origin)));
  return { origin, x, y: cross(z, x), z };
}

/** Corners in the panel's own plane. */
function outline_of(corners, points) {
  const { origin, x, y } = frame_of(corners, points);
  return corners.map((k) => {
    const [a, b, c] = minus(at(points, k), origin);
    return [a * x[0] + b * x[1] + c * x[2], a * y[0] + b * y[1] + c * y[2]];
  });
}

/** A convex outline moved inwards. */
function inset(outline, distance) {
  const sides = outline.map(([x1, y1], i) => {
    const [x2, y2] = outline[(i + 1) % outline.length],
      length = Math.hypot(x2 - x1, y2 - y1) || 1,
      [nx, ny] = [-(y2 - y1) / length, (x2 - x1) / length];
    return { nx, ny, c: nx * x1 + ny * y1 + distance };
  });
  return sides.map((side, i) => {
    const before = sides[(i + sides.length - 1) % sides.length],
      area = before.nx * side.ny - before.ny * side.nx;
    return [
      (before.c * side.ny - before.ny * side.c) / area,
      (before.nx * side.c - before.c * side.nx) / area,
    ];
  });
}

/** Triangles of one plate in its own frame: { corners, side }, side 1 above, -1 below, 0 at edges. */
function plate_of(outline, thickness) {
  const half = thickness / 2,
    ring = (distance, z) => inset(outline, distance).map(([x, y]) => [x, y, z]);
  const middle = ring(kGap * thickness, 0),
    triangles = [];
  for (const side of [1, -1]) {
    const face = ring(half, side * half);
    const add = (a, b, c, kind) =>
      triangles.push({ corners: side > 0 ? [a, b, c] : [a, c, b], side: kind });
    for (let i = 1; i + 1 < face.length; ++i) add(face[0], face[i], face[i + 1], side);
    face.forEach((corner, i) => {
      const next = (i + 1) % face.length;
      add(middle[i], middle[next], face[next], 0);
      add(middle[i], face[next], corner, 0);
    });
  }
  return triangles;
}

const kColours = { 1: "panel-front", "-1": "panel-back", 0: "panel-rim" };

export class PanelSolids {
  #corners;
  #plates; // { first, places, normals, sides } of each panel
  #lit = new MeshLambertMaterial({ vertexColors: true });
  #plain = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }); // not shaded
  mesh;

  /** `corners` of each panel, counterclockwise seen from above the flat sheet `points`. */
  constructor(corners, points, thickness) {
    this.#corners = corners;
    let first = 0;
    this.#plates = corners.map((list) => {
      const triangles = plate_of(outline_of(list, points), thickness),
        places = triangles.flatMap((triangle) => triangle.corners),
        normals = triangles.flatMap(({ corners: [a, b, c] }) => {
          const normal = unit(cross(minus(b, a), minus(c, a)));
          return [normal, normal, normal];
        });
      const plate = { first, places, normals, sides: triangles.map(({ side }) => side) };
      first += places.length;
      return plate;
    });
    const geometry = new BufferGeometry();
    for (const name of ["position", "normal", "color"])
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * first), 3));
    this.mesh = new Mesh(geometry, this.#lit);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
  }

  move(points) {
    const { position, normal } = this.mesh.geometry.attributes;
    this.#plates.forEach(({ first, places, normals }, panel) => {
      const { origin, x, y, z } = frame_of(this.#corners[panel], points);
      places.forEach(([a, b, c], n) => {
        const [u, v, w] = normals[n],
          k = 3 * (first + n);
        for (let i = 0; i < 3; ++i) {
          position.array[k + i] = origin[i] + a * x[i] + b * y[i] + c * z[i];
          normal.array[k + i] = u * x[i] + v * y[i] + w * z[i];
        }
      });
    });
    position.needsUpdate = normal.needsUpdate = true;
  }

  /** Colours each panel; null: the colours of its sides. Exact colours are not shaded. */
  paint(colours, exact) {
    const { color } = this.mesh.geometry.attributes,
      rgb = new Color(),
      own = Object.fromEntries(
        Object.entries(kColours).map(([side, name]) => [side, new Color(colour(name))]),
      );
    this.#plates.forEach(({ first, sides }, panel) => {
      const given = colours?.[panel];
      sides.forEach((side, i) => {
        const shown = given ? rgb.set(given) : own[side];
        for (let n = 0; n < 3; ++n) shown.toArray(color.array, 3 * (first + 3 * i + n));
      });
    });
    color.needsUpdate = true;
    this.mesh.material = exact ? this.#plain : this.#lit;
  }

  dispose() {
    this.mesh.geometry.dispose();
    this.#lit.dispose();
    this.#plain.dispose();
  }
}
