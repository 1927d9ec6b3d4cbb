// Zooms and moves a drawing: by wheel or two fingers, dragging, keys and buttons.
import { clamp, h } from "./format.js";

const kMost = 24, // largest zoom; 1 shows all
  kStep = 1.4;

/**
 * Shows a part of `whole` ({ x, y, width, height } in the drawing's units) in an SVG of any size in
 * px. `changed(scale)` is called with px per unit whenever the view changes.
 */
export class ZoomedView {
  #svg;
  #changed;
  #whole = { x: 0, y: 0, width: 1, height: 1 };
  #size = [1, 1];
  #zoom = 1;
  #centre = [0, 0];
  #fingers = new Map();

  constructor(svg, changed) {
    [this.#svg, this.#changed] = [svg, changed];
    svg.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    svg.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      svg.setPointerCapture(event.pointerId);
      this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    svg.addEventListener("pointermove", (event) => this.#drag(event));
    for (const end of ["pointerup", "pointercancel"])
      svg.addEventListener(end, (event) => this.#fingers.delete(event.pointerId));
    svg.addEventListener("keydown", (event) => this.#key(event));
  }

  /** Takes another drawing; the view stays. */
  set_whole(whole) {
    const first = this.#whole.width === 1;
    this.#whole = whole;
    if (first) this.#centre = [whole.x + whole.width / 2, whole.y + whole.height / 2];
    this.#show();
  }

  resize(width, height) {
    this.#size = [width, height];
    this.#show();
  }

  fit() {
    this.#zoom = 1;
    this.#show();
  }

  /** Zooms about a place in px, or the middle. */
  zoom_by(factor, [px, py] = this.#size.map((side) => side / 2)) {
    const before = this.#scale();
    this.#zoom = clamp(this.#zoom * factor, 1, kMost);
    const share = 1 / before - 1 / this.#scale();
    this.#centre[0] += (px - this.#size[0] / 2) * share;
    this.#centre[1] += (py - this.#size[1] / 2) * share;
    this.#show();
  }

  move_by(dx_px, dy_px) {
    this.#centre[0] -= dx_px / this.#scale();
    this.#centre[1] -= dy_px / this.#scale();
    this.#show();
  }

  /** Position in px of a place in the drawing's units. */
  place([x, y]) {
    const scale = this.#scale();
    return [
      (x - this.#centre[0]) * scale + this.#size[0] / 2,
      (y - this.#centre[1]) * scale + this.#size[1] / 2,
    ];
  }

  buttons() {
    return [
      ["+", () => this.zoom_by(kStep), "Larger", "zoom-in"],
      ["−", () => this.zoom_by(1 / kStep), "Smaller", "zoom-out"],
      ["Fit", () => this.fit(), "Whole sheet", "zoom-fit"],
    ].map(([words, onclick, title, id]) =>
      h(
        "button",
        { type: "button", title, "aria-label": title, "data-testid": id, onclick },
        words,
      ),
    );
  }

  #scale() {
    const [width, height] = this.#size;
    return this.#zoom * Math.min(width / this.#whole.width, height / this.#whole.height);
  }

  #show() {
    const scale = this.#scale();
    const parts = this.#size.map((side) => side / scale);
    const { x, y, width, height } = this.#whole;
    // The view stays within the drawing, in whose middle it is where all of it fits.
    [
      [x, width],
      [y, height],
    ].forEach(([from, length], i) => {
      const half = Math.min(parts[i], length) / 2;
      this.#centre[i] = clamp(this.#centre[i], from + half, from + length - half);
    });
    const corner = this.#centre.map((middle, i) => middle - parts[i] / 2);
    this.#svg.setAttribute("viewBox", [...corner, ...parts].map((v) => v.toFixed(3)).join(" "));
    this.#svg.classList.toggle("zoomed", this.#zoom > 1.001);
    this.#changed(scale);
  }

  #at(event) {
    const frame = this.#svg.getBoundingClientRect();
    return [event.clientX - frame.left, event.clientY - frame.top];
  }

  // The wheel scrolls the page until the drawing is clicked; two fingers on a touchpad are a wheel
  // with Ctrl.
  #wheel(event) {
    if (!event.ctrlKey && !event.metaKey && document.activeElement !== this.#svg) return;
    event.preventDefault();
    this.zoom_by(Math.exp(-clamp(event.deltaY, -100, 100) * 0.004), this.#at(event));
  }

  #drag(event) {
    const before = this.#fingers.get(event.pointerId);
    if (!before) return;
    if (event.buttons === 0) return void this.#fingers.delete(event.pointerId); // released outside
    const now = [event.clientX, event.clientY],
      other = [...this.#fingers].find(([id]) => id !== event.pointerId)?.[1];
    this.#fingers.set(event.pointerId, now);
    if (!other) return this.move_by(now[0] - before[0], now[1] - before[1]);
    const apart = ([x, y]) => Math.hypot(x - other[0], y - other[1]) || 1;
    this.move_by((now[0] - before[0]) / 2, (now[1] - before[1]) / 2);
    this.zoom_by(apart(now) / apart(before), this.#at(event));
  }

  #key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const action = {
      "+": () => this.zoom_by(kStep),
      "=": () => this.zoom_by(kStep),
      "-": () => this.zoom_by(1 / kStep),
      0: () => this.fit(),
      ArrowLeft: () => this.move_by(40, 0),
      ArrowRight: () => this.move_by(-40, 0),
      ArrowUp: () => this.move_by(0, 40),
      ArrowDown: () => this.move_by(0, -40),
    }[event.key];
    if (!action) return;
    action();
    event.preventDefault();
  }
}
