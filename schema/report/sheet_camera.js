// The camera of the folding pictures, and how mouse, touch and keys move it. Two pictures side by
// side have one.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const kFov_deg = 30;
const kFilled = 0.94; // share of the view that a fitted sheet takes
const kOblique = new Vector3(0.37, -0.696, 0.616); // towards the camera
const kTop = new Vector3(0, -0.0017, 1); // x to the right

export class SheetCamera {
  camera = new PerspectiveCamera(kFov_deg, 1, 1, 1e6);
  #target = new Vector3();
  #whole_values = [];
  #moved = [];
  #updates = false; // all controls: their changes are one

  constructor() {
    this.camera.up.set(0, 0, 1);
  }

  set aspect(aspect) {
    if (aspect === this.camera.aspect) return;
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Lets a canvas move the camera; `moved()` is called whenever any canvas has. */
  attach(canvas, moved) {
    const controls = new OrbitControls(this.camera, canvas);
    controls.target = this.#target;
    controls.zoomSpeed = 0.6;
    // The wheel scrolls the page until the sheet is clicked.
    controls.enableZoom = false;
    canvas.addEventListener("focus", () => (controls.enableZoom = true));
    canvas.addEventListener("blur", () => (controls.enableZoom = false));
    controls.addEventListener("change", () => !this.#updates && this.#changed());
    canvas.addEventListener("keydown", (event) => this.#key(event, controls));
    this.#moved.push({ moved, controls });
  }

  /** Views all points from a direction, as near as they fit. */
  #look(direction, values) {
    const camera = this.camera,
      towards = direction.clone().normalize(),
      right = camera.up.clone().cross(towards).normalize(),
      up = towards.clone().cross(right),
      point = new Vector3();
    const slope = kFilled * Math.tan((kFov_deg * Math.PI) / 180 / 2);
    let distance = 1;
    for (let i = 0; i < values.length; i += 3) {
      point.set(values[i], values[i + 1], values[i + 2]);
      distance = Math.max(
        distance,
        point.dot(towards) +
          Math.max(Math.abs(point.dot(right)) / camera.aspect, Math.abs(point.dot(up))) / slope,
      );
    }
    this.#target.set(0, 0, 0);
    camera.position.copy(towards).multiplyScalar(distance);
    camera.near = distance / 50;
    camera.far = distance * 20;
    camera.updateProjectionMatrix();
    this.#update();
  }

  /** The oblique view at the scale of these points. */
  whole(values) {
    this.#whole_values = values;
    this.#look(kOblique, values);
  }

  /** The view of the crease pattern. */
  top(values) {
    this.#look(kTop, values);
  }

  /** The present direction, as near as these points fit. */
  fit(values) {
    this.#look(this.camera.position.clone().sub(this.#target), values);
  }

  #changed() {
    this.camera.updateMatrixWorld();
    for (const { moved } of this.#moved) moved();
  }

  #update() {
    this.#updates = true;
    for (const { controls } of this.#moved) controls.update();
    this.#updates = false;
    this.#changed();
  }

  #key(event, controls) {
    const action = {
      ArrowLeft: () => controls.rotateLeft(0.12),
      ArrowRight: () => controls.rotateLeft(-0.12),
      ArrowUp: () => controls.rotateUp(0.1),
      ArrowDown: () => controls.rotateUp(-0.1),
      "+": () => controls.dollyIn(0.9),
      "=": () => controls.dollyIn(0.9),
      "-": () => controls.dollyOut(0.9),
      0: () => this.whole(this.#whole_values),
    }[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  }
}
