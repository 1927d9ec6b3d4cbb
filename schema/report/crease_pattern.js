// Draws the selected draw's crease pattern, as in figure 12b of the paper: mountains, valleys,
// holes, numbered diagonals, and enlarged shifts as arrows.
import { label_px, number_px, place_labels } from "./crease_labels.js";
import { ends_of, label_of } from "./data.js";
import { clamp, h } from "./format.js";
import { on_print, paper_share } from "./paper.js";
import { line, panel_size_mm, polygon, sheet_extent, sheet_svg, view_height } from "./sheet.js";
import { ZoomedView } from "./zoomed_view.js";

const kMostWide_px = 1000,
  kPaper_px = 330, // height on paper, as page.css has it
  kLeastPanel_px = 45; // smaller panels give the drawing the full width

const kNumberAt = [0.27, 0.2, 0.35, 0.73, 0.8]; // along the diagonal

const kLegend = [
  ["mountain", "mountain"],
  ["valley", "valley"],
  ["cut", "cut"],
  ["grows", "increasing diagonal"],
  ["shrinks", "decreasing diagonal"],
  ["pilot-crease", "pilot crease"],
];

/** The largest round factor that keeps the longest arrow below two fifths of a panel. */
function arrow_scale(longest_mm, size_mm) {
  if (longest_mm === 0) return 1;
  let best = 1;
  for (let power = 1; power < 1e9; power *= 10) {
    for (const factor of [1, 2, 5])
      if (factor * power * longest_mm <= 0.4 * size_mm) best = factor * power;
  }
  return best;
}

const definitions = (size) =>
  h(
    "svg:defs",
    {},
    h(
      "svg:pattern",
      {
        id: "hatch",
        width: 0.11 * size,
        height: 0.11 * size,
        patternUnits: "userSpaceOnUse",
        patternTransform: "rotate(45)",
      },
      h("svg:line", {
        x1: 0,
        y1: 0,
        x2: 0,
        y2: 0.11 * size,
        class: "hatch-line",
        "stroke-width": 0.02 * size,
      }),
    ),
    h(
      "svg:marker",
      {
        id: "arrow-head",
        viewBox: "0 0 10 10",
        refX: 8.5,
        refY: 5,
        markerWidth: 4.6,
        markerHeight: 4.6,
        orient: "auto",
      },
      h("svg:path", { d: "M0,0 L10,5 L0,10 L2.5,5 z", class: "arrow-head" }),
    ),
  );

const legend = () =>
  h(
    "ul",
    { class: "legend crease-legend" },
    kLegend.map(([kind, words]) =>
      h(
        "li",
        {},
        h(
          "svg:svg",
          { viewBox: "0 0 34 8", class: "key" },
          h("svg:line", { x1: 0, y1: 4, x2: 34, y2: 4, class: `key-${kind}` }),
        ),
        words,
      ),
    ),
  );

class CreasePattern {
  #box;
  #caption;
  #report;
  #state;
  #size_mm;
  #svg;
  #view;
  #wide_button;
  #wide = null; // the reader's choice, if any
  #width_px = 0;
  #share = null; // of the screen's width, on paper
  #diagonals = [];
  #labels = [];
  #scaled_for = [null, 0]; // labels and scale of the present strokes and letters
  #balls = [];

  constructor(box, caption, report, state) {
    [this.#box, this.#caption, this.#report, this.#state] = [box, caption, report, state];
    const { sheet } = report;
    this.#size_mm = panel_size_mm(sheet);
    this.#svg = sheet_svg(
      sheet.vertices_mm,
      0.32 * this.#size_mm,
      "Crease pattern: mountains dash-dotted red, valleys dashed blue, holes hatched, diagonals numbered, shifts as arrows. Keys: plus and minus zoom, arrows move, 0 shows the whole sheet.",
    );
    this.#svg.setAttribute("role", "application"); // it has keys, and its parts have names
    this.#svg.setAttribute("tabindex", 0);
    this.#svg.setAttribute("data-testid", "crease-drawing");
    this.#view = new ZoomedView(this.#svg, (scale) => this.#scaled(scale));
    this.#wide_button = h("button", {
      type: "button",
      "data-testid": "crease-wide",
      onclick: () => this.#set_wide(!this.#is_wide()),
    });
    const buttons = h(
      "div",
      { class: "view-buttons upright" },
      this.#view.buttons(),
      this.#wide_button,
    );
    box.replaceChildren(this.#svg, buttons, legend());
    new ResizeObserver(() => this.#resize()).observe(box);
    on_print((printing) => {
      this.#share = printing ? paper_share() : null;
      this.#resize();
    });
  }

  get drawing() {
    return this.#svg;
  }

  load(detail, decoded) {
    const { sheet } = this.#report,
      shift_of = (k) => detail.displacements_mm[label_of(k)] ?? [0, 0];
    const at = sheet.vertices_mm.map(([x, y], k) => [x + shift_of(k)[0], y + shift_of(k)[1]]);
    const shifts = Object.entries(detail.displacements_mm).filter(([, [x, y]]) => x || y);
    const longest = Math.max(0, ...shifts.map(([, shift]) => Math.hypot(...shift)));
    const scale = arrow_scale(longest, this.#size_mm);
    this.#labels = [];
    this.#svg.replaceChildren(definitions(this.#size_mm));
    this.#add_sheet(at);
    this.#diagonals = this.#report.diagonals.map((diagonal, d) =>
      this.#add_diagonal(diagonal, d, at, decoded.grows[d]),
    );
    this.#balls = sheet.ball_joints.map((k) =>
      h("svg:circle", { cx: at[k][0], cy: -at[k][1], class: "ball" }),
    );
    this.#svg.append(...this.#balls);
    for (const [name, shift] of shifts) this.#add_shift(name, shift, at, scale);
    this.#caption.textContent =
      `Flat sheet, top view (+z). Shifts enlarged ×${scale.toLocaleString("en")} (longest: ${longest.toFixed(2)} mm). ` +
      "Numbers: diagonals, as in catalogue and exports. Circles: ball joints. To zoom, click, then turn the wheel.";
    this.#view.set_whole(sheet_extent(at, 0.32 * this.#size_mm));
  }

  mark(picked) {
    this.#svg.classList.toggle("has-picked", picked !== null);
    this.#diagonals.forEach((group, d) => group.classList.toggle("picked", d === picked));
  }

  #add_sheet(at) {
    const { sheet } = this.#report,
      svg = this.#svg;
    for (const panel of sheet.panels) svg.append(polygon(panel, at, { class: "panel" }));
    for (const hole of sheet.holes) svg.append(polygon(hole.corners, at, { class: "hole" }));
    for (const [a, b] of sheet.cuts) svg.append(line(at[a], at[b], { class: "cut" }));
    for (const { a, b, assignment } of sheet.creases)
      svg.append(line(at[a], at[b], { class: assignment }));
    const [p, q] = sheet.pilot;
    svg.append(line(at[p], at[q], { class: "pilot-crease" }));
  }

  #add_diagonal(diagonal, d, at, grows) {
    const [a, b] = [at[diagonal.from_vertex], at[diagonal.to_vertex]];
    const way = grows ? "increasing" : "decreasing";
    const number = h("svg:text", {}, String(d));
    const group = h(
      "svg:g",
      { class: `diagonal ${grows ? "grows" : "shrinks"}`, "data-diagonal": d },
      h("svg:title", {}, `diagonal ${d}: ${diagonal.from}–${diagonal.to}, ${way} as it folds`),
      line(a, b, { class: "reach" }),
      line(a, b, { class: "stroke" }),
      number,
    );
    group.addEventListener("pointerenter", () => this.#state.set("diagonal", d));
    group.addEventListener("pointerleave", () => this.#state.set("diagonal", null));
    this.#svg.append(group);
    // Numbers stand off the crossing, each towards the end where its diagonal begins.
    const places = kNumberAt.map((t) => [a[0] + t * (b[0] - a[0]), -(a[1] + t * (b[1] - a[1]))]);
    this.#labels.push({ node: number, places, away: null, bold: true });
    return group;
  }

  #add_shift(name, shift, at, scale) {
    const k = ends_of(name)[0],
      length = Math.hypot(...shift),
      tip = [at[k][0] + scale * shift[0], at[k][1] + scale * shift[1]];
    const words = h("svg:title", {}, `${name} shifted by (${shift[0]}, ${shift[1]}) mm`);
    const arrow = line(at[k], tip, { class: "arrow", "marker-end": "url(#arrow-head)" });
    arrow.append(words);
    const label = h("svg:text", { class: "vertex-label" }, label_of(k));
    this.#svg.append(arrow, label);
    // Opposite the arrow, so that neither covers the other.
    const away = [-shift[0] / length, shift[1] / length];
    this.#labels.push({ node: label, places: [[at[k][0], -at[k][1]]], away });
  }

  /** Strokes and letters for a scale in px a mm: between those of a small and of a large panel. */
  #scaled(scale) {
    const [labels, before] = this.#scaled_for;
    if (labels === this.#labels && before === scale) return; // moved only
    this.#scaled_for = [this.#labels, scale];
    const panel_px = this.#size_mm * scale,
      size = clamp(panel_px, 50, 110) / scale;
    const dash = (...parts) => parts.map((part) => `${(part * size).toFixed(3)}px`).join(" ");
    const style = this.#svg.style;
    style.setProperty("--size", size.toFixed(4));
    style.setProperty("--dash-mountain", dash(0.17, 0.045, 0.03, 0.045));
    style.setProperty("--dash-valley", dash(0.1, 0.06));
    style.setProperty("--dash-shrinks", dash(0.05, 0.035));
    for (const ball of this.#balls) ball.setAttribute("r", (0.028 * size).toFixed(4));
    for (const label of this.#labels)
      label.size_px = label.away ? label_px(panel_px) : number_px(panel_px);
    place_labels(this.#labels, this.#view, scale);
  }

  #is_wide() {
    return this.#wide ?? this.#box.closest(".card").classList.contains("wide");
  }

  /** Lays the card over the whole width, or over half of it. */
  #set_wide(wide, asked = true) {
    if (asked) this.#wide = wide;
    this.#box.closest(".card").classList.toggle("wide", wide);
    const words = wide ? "Half width" : "Full width";
    this.#wide_button.textContent = "⇔";
    this.#wide_button.title = words;
    this.#wide_button.setAttribute("aria-label", words);
    this.#wide_button.setAttribute("aria-pressed", String(wide));
    this.#resize();
  }

  #resize() {
    const width = Math.floor(this.#box.clientWidth);
    if (!width) return;
    const whole = sheet_extent(this.#report.sheet.vertices_mm, 0.32 * this.#size_mm);
    if (this.#width_px === 0 && this.#wide === null) {
      this.#width_px = width;
      const scale = Math.min(width / whole.width, view_height(width) / whole.height);
      return this.#set_wide(this.#size_mm * scale < kLeastPanel_px, false);
    }
    this.#width_px = width;
    if (this.#share) return this.#fill(width * this.#share, kPaper_px);
    const alone = this.#is_wide() || matchMedia("(max-width: 860px)").matches; // as page.css has it
    const height = alone
      ? Math.min((width * whole.height) / whole.width, kMostWide_px)
      : view_height(width);
    this.#fill(width, height);
  }

  #fill(width, height) {
    this.#svg.style.height = `${Math.round(height)}px`;
    this.#view.resize(Math.round(width), Math.round(height));
  }
}

export const make_crease_pattern = (box, caption, report, state) =>
  new CreasePattern(box, caption, report, state);
