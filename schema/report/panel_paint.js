// Colours the panels in the folding picture: by their largest stress, or their distance from the
// target where the sheet has its shape; and those in contact.
import { colour_scale } from "./colour_scale.js";
import { contact_panels } from "./contact.js";
import { h, number } from "./format.js";
import { panel_name } from "./sheet.js";
import { colour } from "./theme.js";

const kTip_px = 14; // away from the pointer

const stress_scale = () =>
  colour_scale(["least", "middle", "most"].map((name) => colour(`stress-${name}`)));

/** Colours of the panels on a scale from 0 to the largest value, in the present theme. */
export function stress_colours(panels_mpa) {
  const scale = stress_scale(),
    most = Math.max(...panels_mpa) || 1;
  return panels_mpa.map((stress) => scale(stress / most));
}

const mpa = (stress) => (stress > 0 ? `${number(stress)} MPa` : "no node outside the discs");
const kAtShape_deg = 0.6; // a sample this near has the shape

/** The values that colour panels: { values, words, least, note, button, caption, pilot_deg }, or null. */
function paint_of({ stress, target }) {
  if (stress)
    return {
      values: stress.panels_mpa,
      words: mpa,
      least: "0 MPa",
      note: "largest von Mises stress outside the discs",
      button: "Stress",
      caption: "Colour: largest stress. ",
    };
  if (target)
    return {
      values: target.panels_mm,
      words: (mm) => `${number(mm)} mm`,
      least: "0 mm",
      note: `distance from the target at ${number(target.pilot_deg)}°`,
      button: "Distance",
      caption: "Colour: largest distance from the target. ",
      pilot_deg: target.pilot_deg,
    };
  return null;
}

/** The pair of every edge of these panels. */
const edges_of = (panels) =>
  panels.flatMap((corners) => corners.map((a, i) => [a, corners[(i + 1) % corners.length]]));

export class PanelPaint {
  #sheet;
  #changed;
  #paint = null; // see paint_of
  #near = true; // the pose is one to which the colours belong
  #contact = null; // { pilot_deg, panels: [i, j] }, or null
  #on = true; // for every draw that has colours
  #met = false;
  #scale = h(
    "div",
    { class: "scale stress-scale", "data-testid": "stress-scale" },
    h("span"),
    h("i"),
    h("span"),
    h("span", { class: "note" }),
  );
  #met_key = h(
    "ul",
    { class: "legend met-legend", "data-testid": "met-legend" },
    h("li", {}, h("i"), h("span")),
  );
  #tip = h("div", { class: "tip", "data-testid": "panel-tip", hidden: true });
  button = h(
    "button",
    {
      type: "button",
      title: "Colour of panels: value or side",
      "data-testid": "stress-button",
      onclick: () => this.#turn(!this.#on),
    },
    "Stress",
  );
  /** Edges of the panels in contact, as a part for the pen. */
  outline = { pairs: [], width: 3.5, colour: "contact", on_top: true, hidden: true };

  /** `changed` is called when the panels' colours change. */
  constructor(box, sheet, changed) {
    [this.#sheet, this.#changed] = [sheet, changed];
    box.append(this.#scale, this.#met_key, this.#tip);
  }

  load(detail) {
    this.#paint = paint_of(detail);
    this.#near = this.#paint?.pilot_deg === undefined;
    this.#contact = contact_panels(this.#sheet, detail.contact);
    this.#met = false;
    this.button.hidden = !this.#paint;
    if (this.#paint) {
      const { values, words, least, note, button } = this.#paint,
        [first, , last, under] = this.#scale.children;
      [first.textContent, last.textContent] = [least, words(Math.max(...values))];
      [under.textContent, this.button.textContent] = [note, button];
    }
    const corners = this.#contact?.panels.map((panel) => this.#sheet.panels[panel]);
    this.outline.pairs = corners ? edges_of(corners) : [];
    this.#met_key.hidden = !this.#contact;
    if (this.#contact) this.#met_key.querySelector("span").textContent = this.#contact.words;
    this.#show_whether_on();
  }

  /** Shows the contact at a pilot angle; the colours may change. */
  pose(pilot_deg) {
    const at_deg = this.#paint?.pilot_deg,
      near = at_deg === undefined || Math.abs(pilot_deg - at_deg) < kAtShape_deg;
    if (near !== this.#near) {
      this.#near = near;
      this.#show_whether_on();
      this.#changed();
    }
    const met = this.#contact !== null && pilot_deg >= this.#contact.pilot_deg;
    this.outline.hidden = !met;
    this.#met_key.classList.toggle("met", met);
    if (met === this.#met) return;
    this.#met = met;
    this.#changed();
  }

  /**
   * { colours, exact, caption }: a colour for each panel, or null for those of its sides. Exact
   * colours are read off a scale, which the caption names: they are not shaded.
   */
  tint() {
    const exact = this.#shows_values();
    const colours = exact ? stress_colours(this.#paint.values) : this.#sheet.panels.map(() => null);
    if (this.#met && !exact)
      for (const panel of this.#contact.panels) colours[panel] = colour("contact-panel");
    return { colours, exact, caption: exact ? this.#paint.caption : null };
  }

  /** Shows the tip of the panel under the pointer; null: hides it. */
  say(panel, event, box) {
    const words = panel === null ? null : this.#words(panel);
    this.#tip.hidden = words === null;
    if (words === null) return;
    this.#tip.textContent = words;
    const frame = box.getBoundingClientRect(),
      x = event.clientX - frame.left,
      left = x > frame.width / 2;
    this.#tip.style.left = left ? "auto" : `${x + kTip_px}px`;
    this.#tip.style.right = left ? `${frame.width - x + kTip_px}px` : "auto";
    this.#tip.style.top = `${event.clientY - frame.top + kTip_px}px`;
  }

  #words(panel) {
    const value = this.#shows_values() ? `: ${this.#paint.words(this.#paint.values[panel])}` : "",
      met = this.#met && this.#contact.panels.includes(panel) ? ", in contact with another" : "";
    return value || met ? panel_name(this.#sheet, panel) + value + met : null;
  }

  #shows_values() {
    return this.#on && this.#near && this.#paint !== null;
  }

  #turn(on) {
    this.#on = on;
    this.#show_whether_on();
    this.#changed();
  }

  #show_whether_on() {
    this.button.setAttribute("aria-pressed", String(this.#on));
    this.#scale.hidden = !this.#shows_values();
  }
}
