// The camera of the folding pictures, and how mouse, touch and keys move it. Two pictures side by
// side have one.
import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { clamp } from "./format.js";

const kFov_deg = 30;
const kFilled = 0.94; // share of the view that a fitted sheet takes
const kOblique_deg = [-62, 38];

const rad = (deg) => (deg * Math.PI) / 180;

export class SheetCamera {
  camera = new PerspectiveCamera(kFov_deg, 1, 1, 1e6);
  #target = new Vector3();
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
    canvas.addEventListener("keydown", (event) => this.#key(event));
    this.#moved.push({ moved, controls });
  }

  /** Views all points from a direction, as near as they fit. */
  look(azimuth_deg, elevation_deg, values) {
    const [az, el] = [rad(azimuth_deg), rad(elevation_deg)],
      camera = this.camera;
    const towards = new Vector3(
      Math.cos(el) * Math.cos(az),
      Math.cos(el) * Math.sin(az),
      Math.sin(el),
    );
    const right = new Vector3(-Math.sin(az), Math.cos(az), 0),
      up = towards.clone().cross(right),
      point = new Vector3();
    const slope = kFilled * Math.tan(rad(kFov_deg) / 2);
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
    this.look(...kOblique_deg, values);
  }

  /** The present direction, as near as these points fit. */
  fit(values) {
    const { azimuth, elevation } = this.#angles();
    this.look(azimuth / rad(1), elevation / rad(1), values);
  }

  #whole_values = [];

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

  #angles() {
    const away = this.camera.position.clone().sub(this.#target),
      distance = away.length();
    return {
      azimuth: Math.atan2(away.y, away.x),
      elevation: Math.asin(away.z / distance),
      distance,
    };
  }

  #turn(azimuth, elevation, factor) {
    const now = this.#angles(),
      el = clamp(now.elevation + elevation, -1.5, 1.5),
      az = now.azimuth + azimuth;
    this.camera.position
      .set(Math.cos(el) * Math.cos(az), Math.cos(el) * Math.sin(az), Math.sin(el))
      .multiplyScalar(now.distance * factor)
      .add(this.#target);
    this.#update();
  }

  #key(event) {
    const action = {
      ArrowLeft: () => this.#turn(-0.12, 0, 1),
      ArrowRight: () => this.#turn(0.12, 0, 1),
      ArrowUp: () => this.#turn(0, 0.1, 1),
      ArrowDown: () => this.#turn(0, -0.1, 1),
      "+": () => this.#turn(0, 0, 0.9),
      "=": () => this.#turn(0, 0, 0.9),
      "-": () => this.#turn(0, 0, 1 / 0.9),
      0: () => this.whole(this.#whole_values),
    }[event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    action();
    event.preventDefault();
  }
}
