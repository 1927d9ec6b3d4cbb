// The rigid panels as plates with bevelled edges, in one mesh that moves with the vertices.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Triangle,
  Vector3,
} from "three";
import { colour } from "./theme.js";

const kGap = 0.25; // half the gap at a crease, of the thickness

/** Writes a panel's frame: its first corner, the direction of its first edge, and two across it. */
const write_frame = (() => {
  const [origin, x, y, z] = Array.from({ length: 4 }, () => new Vector3());
  return (matrix, corners, points) => {
    origin.fromArray(points, 3 * corners[0]);
    x.fromArray(points, 3 * corners[1])
      .sub(origin)
      .normalize();
    y.fromArray(points, 3 * corners.at(-1)).sub(origin);
    z.crossVectors(x, y).normalize();
    return matrix.makeBasis(x, y.crossVectors(z, x), z).setPosition(origin);
  };
})();

/** Corners in the panel's own plane. */
function outline_of(corners, points) {
  const inverse = write_frame(new Matrix4(), corners, points).invert();
  return corners.map((k) => {
    const { x, y } = new Vector3().fromArray(points, 3 * k).applyMatrix4(inverse);
    return [x, y];
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
    ring = (distance, z) => inset(outline, distance).map(([x, y]) => new Vector3(x, y, z));
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
  #face_vertices; // their number, without those of the rims
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
        normals = triangles.map(({ corners: [a, b, c] }) =>
          Triangle.getNormal(a, b, c, new Vector3()),
        );
      const plate = { first, places, normals, sides: triangles.map(({ side }) => side) };
      first += places.length;
      return plate;
    });
    const geometry = new BufferGeometry();
    for (const name of ["position", "normal", "color"])
      geometry.setAttribute(name, new BufferAttribute(new Float32Array(3 * first), 3));
    const vertices_of = (is_rim) =>
      this.#plates.flatMap((plate) =>
        plate.sides.flatMap((side, i) =>
          (side === 0) === is_rim ? [0, 1, 2].map((n) => plate.first + 3 * i + n) : [],
        ),
      );
    const faces = vertices_of(false);
    this.#face_vertices = faces.length;
    geometry.setIndex([...faces, ...vertices_of(true)]);
    this.mesh = new Mesh(geometry, this.#lit);
    this.mesh.frustumCulled = false;
    this.mesh.castShadow = this.mesh.receiveShadow = true;
  }

  move(points) {
    const { position, normal } = this.mesh.geometry.attributes,
      frame = new Matrix4(),
      shown = new Vector3();
    this.#plates.forEach(({ first, places, normals }, panel) => {
      write_frame(frame, this.#corners[panel], points);
      places.forEach((place, n) => {
        const k = 3 * (first + n);
        shown.copy(place).applyMatrix4(frame).toArray(position.array, k);
        if (n % 3 === 0) shown.copy(normals[n / 3]).transformDirection(frame);
        else shown.fromArray(normal.array, k - 3);
        shown.toArray(normal.array, k);
      });
    });
    position.needsUpdate = normal.needsUpdate = true;
  }

  /** Draws the plates' rims, or only their faces. */
  show_rims(are_shown) {
    this.mesh.geometry.setDrawRange(0, are_shown ? Infinity : this.#face_vertices);
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
