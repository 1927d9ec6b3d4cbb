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

/** Panels by their `corners`; `parts` are lines: { pairs, width, colour, dashed, on_top }. */
export function webgl_pen(canvas) {
  const renderer = new WebGLRenderer({
    canvas,
    antialias: true,
    alpha: true,
    preserveDrawingBuffer: true,
  });
  const scene = new Scene(),
    lamp = new DirectionalLight(0xffffff, 1.9);
  scene.add(new AmbientLight(0xffffff, 1.7), lamp);
  let group = null,
    panels = null,
    lines = [];

  function segments(part) {
    const geometry = new LineSegmentsGeometry();
    geometry.setPositions(new Float32Array(part.pairs.length * 6));
    if (part.dashed) new LineSegments2(geometry).computeLineDistances();
    const dashes = part.dashed
      ? { dashed: true, dashSize: part.dash, gapSize: part.dash * 0.75 }
      : {};
    const material = new LineMaterial({
      linewidth: part.width,
      depthTest: !part.on_top,
      depthWrite: !part.on_top,
      ...dashes,
    });
    const mesh = new LineSegments2(geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = part.on_top ? 2 : 1;
    return { part, mesh };
  }

  return {
    load(corners, parts) {
      if (group) {
        scene.remove(group);
        group.traverse((node) => {
          node.geometry?.dispose();
          node.material?.dispose();
        });
      }
      const geometry = new BufferGeometry();
      geometry.setAttribute(
        "position",
        new BufferAttribute(new Float32Array(corners.length * 18), 3),
      );
      panels = { corners, geometry };
      group = new Group();
      for (const [side, name] of [
        [FrontSide, "panel-front"],
        [BackSide, "panel-back"],
      ]) {
        const mesh = new Mesh(
          geometry,
          new MeshLambertMaterial({
            side,
            flatShading: true,
            polygonOffset: true,
            polygonOffsetFactor: 1,
            polygonOffsetUnits: 2,
          }),
        );
        mesh.userData.colour = name;
        mesh.frustumCulled = false;
        group.add(mesh);
      }
      lines = parts.filter((part) => part.pairs.length > 0).map(segments);
      group.add(...lines.map(({ mesh }) => mesh));
      scene.add(group);
    },
    recolour() {
      group?.children.forEach(
        (mesh) => mesh.userData.colour && mesh.material.color.set(colour(mesh.userData.colour)),
      );
      for (const { part, mesh } of lines) mesh.material.color.set(colour(part.colour));
    },
    resize(width, height) {
      renderer.setPixelRatio(Math.min(2, devicePixelRatio || 1));
      renderer.setSize(width, height, false);
    },
    draw(points, camera) {
      if (!group) return;
      const positions = panels.geometry.attributes.position;
      panels.corners.forEach(([a, b, c, d], i) =>
        [a, b, c, a, c, d].forEach((k, n) =>
          positions.array.set(points.subarray(3 * k, 3 * k + 3), 18 * i + 3 * n),
        ),
      );
      positions.needsUpdate = true;
      for (const { part, mesh } of lines) {
        const buffer = mesh.geometry.attributes.instanceStart.data;
        part.pairs.forEach(([a, b], i) => {
          buffer.array.set(points.subarray(3 * a, 3 * a + 3), 6 * i);
          buffer.array.set(points.subarray(3 * b, 3 * b + 3), 6 * i + 3);
        });
        buffer.needsUpdate = true;
        if (part.dashed) {
          const distances = mesh.geometry.attributes.instanceDistanceStart.data;
          part.pairs.forEach(([a, b], i) =>
            distances.array.set(
              [0, Math.hypot(...[0, 1, 2].map((x) => points[3 * a + x] - points[3 * b + x]))],
              2 * i,
            ),
          );
          distances.needsUpdate = true;
        }
        mesh.visible = !part.hidden;
      }
      lamp.position.copy(camera.position).add(new Vector3(0, 0, camera.position.length() * 0.6));
      renderer.render(scene, camera);
    },
  };
}
