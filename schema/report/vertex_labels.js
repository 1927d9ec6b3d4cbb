// Names of the vertices over the folding picture, on demand.
import { label_of } from "./data.js";
import { h } from "./format.js";

export class VertexLabels {
  #box = h("div", { class: "vertex-names", "data-testid": "vertex-names", hidden: true });
  button = h(
    "button",
    {
      type: "button",
      title: "Names of vertices; ball joints are circled",
      "aria-pressed": "false",
      "data-testid": "vertex-names-button",
      onclick: () => this.#turn(),
    },
    "Labels",
  );
  #sheet;
  #changed;

  constructor(box, sheet, changed) {
    [this.#sheet, this.#changed] = [sheet, changed];
    box.append(this.#box);
  }

  /** `places`: of each vertex in the box, px. */
  move(places) {
    if (this.#box.hidden) return;
    [...this.#box.children].forEach((name, v) => {
      const [x, y] = places(v);
      name.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px) translate(-50%, -50%)`;
    });
  }

  #turn() {
    const { vertices_mm, ball_joints } = this.#sheet,
      balls = new Set(ball_joints);
    if (!this.#box.firstChild)
      this.#box.append(
        ...vertices_mm.map((_, v) =>
          h("span", { class: balls.has(v) ? "ball-name" : null }, label_of(v)),
        ),
      );
    this.#box.hidden = !this.#box.hidden;
    this.button.setAttribute("aria-pressed", String(!this.#box.hidden));
    this.#changed();
  }
}
