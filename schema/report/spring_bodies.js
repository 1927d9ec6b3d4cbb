// The fillings of holes as bodies: coil springs, struts that push, and rubber plates. A body
// lengthens with its diagonal, and its colour deepens with its force.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Curve,
  CylinderGeometry,
  DoubleSide,
  InstancedMesh,
  Matrix4,
  Mesh,
  MeshLambertMaterial,
  SphereGeometry,
  TubeGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { colour } from "./theme.js";

const kTurns = 9,
  kEnds = 0.14, // share of a spring's length that is straight, at each end
  kMostCoils = 120; // sheets with more springs have bands instead

/** The wire of a spring along z, from 0 to `length`. */
class Coil extends Curve {
  constructor(length, radius) {
    super();
    Object.assign(this, { length, radius });
  }
  getPoint(t, point = new Vector3()) {
    const along = Math.min(1, Math.max(0, (t - kEnds) / (1 - 2 * kEnds))),
      radius = this.radius * Math.min(1, 8 * along, 8 * (1 - along)),
      turn = 2 * Math.PI * kTurns * along;
    return point.set(radius * Math.cos(turn), radius * Math.sin(turn), t * this.length);
  }
}

const upright = (geometry, length) => geometry.rotateX(Math.PI / 2).translate(0, 0, length / 2);

/** A spring that pulls: a coil; one that pushes: a coil about a rod. */
function spring_body(length, size, pushes, is_fine) {
  if (!is_fine)
    return upright(new CylinderGeometry(size / 3, size / 3, length, 5, 1, true), length);
  const coil = new TubeGeometry(new Coil(length, size), 10 * kTurns, size / 5, 3);
  if (!pushes) return coil;
  const rod = upright(new CylinderGeometry(size / 2, size / 2, length, 5, 1, true), length);
  return mergeGeometries([coil, rod]);
}

/** Writes the movement of a body along z to the segment from a to b. */
function stretch(matrix, points, [a, b], length) {
  const from = new Vector3().fromArray(points, 3 * a),
    along = new Vector3().fromArray(points, 3 * b).sub(from),
    size = along.length() || 1,
    z = along.clone().divideScalar(size);
  const x = new Vector3(0, 0, 1).cross(z);
  if (x.lengthSq() < 1e-6) x.set(1, 0, 0);
  x.normalize();
  matrix.makeBasis(x, z.clone().cross(x), along.divideScalar(length)).setPosition(from);
}

/** A mesh that is drawn wherever it moves, and casts a shadow. */
const moving = (mesh) => Object.assign(mesh, { frustumCulled: false, castShadow: true });

export const distance = (points, [a, b]) =>
  Math.hypot(...[0, 1, 2].map((i) => points[3 * a + i] - points[3 * b + i]));

/** The springs of one direction: { pairs, numbers, colour, pushes }. */
class Springs {
  #part;
  #length;
  mesh;

  constructor(part, flat, size) {
    this.#part = part;
    const lengths = part.pairs.map((pair) => distance(flat, pair));
    this.#length = lengths.reduce((sum, length) => sum + length, 0) / lengths.length;
    const is_fine = part.pairs.length <= kMostCoils;
    const body = spring_body(this.#length, size, part.pushes, is_fine);
    this.mesh = moving(new InstancedMesh(body, new MeshLambertMaterial(), part.pairs.length));
  }

  /** `force_share`: the share of the largest force of all springs, for each spring by its number. */
  move(points, force_share) {
    const matrix = new Matrix4(),
      relaxed = new Color(colour("spring")),
      strained = new Color(colour(this.#part.colour)),
      shown = new Color();
    this.#part.pairs.forEach((pair, i) => {
      stretch(matrix, points, pair, this.#length);
      this.mesh.setMatrixAt(i, matrix);
      const share = Math.sqrt(force_share(this.#part.numbers[i]));
      this.mesh.setColorAt(i, shown.lerpColors(relaxed, strained, 0.25 + 0.75 * share));
    });
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.instanceColor.needsUpdate = true;
  }
}

/** Rubber plates in holes, each four triangles about its middle. */
class Plates {
  #holes;
  mesh;

  constructor(holes) {
    this.#holes = holes;
    const geometry = new BufferGeometry();
    const triangles = holes.reduce((sum, corners) => sum + corners.length, 0);
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(9 * triangles), 3));
    const material = new MeshLambertMaterial({
      side: DoubleSide,
      transparent: true,
      opacity: 0.75,
    });
    this.mesh = moving(new Mesh(geometry, material));
  }

  move(points, force_share) {
    const { position } = this.mesh.geometry.attributes;
    let k = 0;
    for (const corners of this.#holes) {
      const places = corners.map((v) => points.subarray(3 * v, 3 * v + 3)),
        middle = [0, 1, 2].map((i) => places.reduce((sum, p) => sum + p[i], 0) / places.length);
      places.forEach((place, n) => {
        for (const corner of [place, places[(n + 1) % places.length], middle]) {
          position.array.set(corner, k);
          k += 3;
        }
      });
    }
    position.needsUpdate = true;
    this.mesh.geometry.computeVertexNormals();
    const [relaxed, strained] = ["rubber", "grows"].map((name) => new Color(colour(name)));
    this.mesh.material.color.lerpColors(relaxed, strained, force_share(null));
  }
}

/** Ball joints, which do not change. */
class Balls {
  #vertices;
  is_small = true;
  mesh;

  constructor(vertices, size) {
    this.#vertices = vertices;
    const geometry = new SphereGeometry(size, 12, 8);
    this.mesh = moving(new InstancedMesh(geometry, new MeshLambertMaterial(), vertices.length));
  }

  move(points) {
    const matrix = new Matrix4();
    this.#vertices.forEach((v, i) => {
      matrix.makeTranslation(points[3 * v], points[3 * v + 1], points[3 * v + 2]);
      this.mesh.setMatrixAt(i, matrix);
    });
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.material.color.set(colour("ball"));
  }
}

/**
 * The bodies of a sheet: { springs: [{ pairs, numbers, colour, pushes }], holes, balls, panel_mm,
 * thickness_mm }. `flat`: its vertices when flat.
 */
export function bodies_of({ springs, holes, balls, panel_mm, thickness_mm }, flat) {
  const size = Math.max(0.03 * panel_mm, 0.8 * thickness_mm);
  return [
    ...springs.filter(({ pairs }) => pairs.length > 0).map((part) => new Springs(part, flat, size)),
    ...(holes.length ? [new Plates(holes)] : []),
    ...(balls.length ? [new Balls(balls, Math.max(0.9 * thickness_mm, 0.018 * panel_mm))] : []),
  ];
}
