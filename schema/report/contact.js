// Describes the first contact of panels.
import { by_id, dashed, degrees, h, number } from "./format.js";
import { panel_at, place_name } from "./sheet.js";

const kNearly_deg = 1e-6;

/** An angle, rounded to four decimals. */
const exactly = (angle_deg) => `${Number(angle_deg.toFixed(4))}°`;

const both_of = ({ panels }) => `panels ${panels.map(place_name).join(" and ")}`;

const how = ({ kind, joint }) =>
  ({
    apart: "which share no vertex",
    vertex: `which share the vertex ${joint}`,
    crease: `on both sides of the crease ${dashed(joint ?? "")}, which is then closed`,
  })[kind] ?? "";

/** { pilot_deg, panels: their numbers on the sheet, words }, or null where none meet. */
export function contact_panels(sheet, contact) {
  const first = contact?.first_contact;
  if (!first) return null;
  return {
    pilot_deg: first.pilot_deg,
    panels: first.panels.map((place) => panel_at(sheet, place)),
    words: `${both_of(first)}, in contact from ${degrees(first.pilot_deg)} on`,
  };
}

function first_words({ first_contact, known_until_deg, deploys_from_deg }) {
  if (!first_contact) return `No two panels meet up to ${exactly(known_until_deg)}.`;
  const { pilot_deg } = first_contact;
  const of_D =
    pilot_deg < deploys_from_deg
      ? `This is before D = ${degrees(deploys_from_deg)}: a real sheet folds no farther.`
      : `No two panels meet up to D = ${degrees(deploys_from_deg)}.`;
  return `At ${exactly(pilot_deg)} two panels first meet: ${both_of(first_contact)}, ${how(first_contact)}. ${deploys_from_deg > 0 ? of_D : ""}`;
}

function unknown_words({ first_contact, known_until_deg, way_ends_at_deg }) {
  if (first_contact || known_until_deg > way_ends_at_deg - kNearly_deg) return null;
  return `Contact is unknown beyond ${exactly(known_until_deg)}: the path, which ends at ${exactly(way_ends_at_deg)}, turns too sharply there.`;
}

/** The largest panel thickness; nothing where panels meet before D. */
function thickness_words({ thickness, first_contact, deploys_from_deg }) {
  if (thickness?.largest_mm === null || thickness?.largest_mm === undefined) return null;
  if (first_contact?.pilot_deg < deploys_from_deg) return null;
  return (
    `Plates of up to ${number(thickness.largest_mm)} mm reach ${degrees(thickness.reaches_deg)}, with edges tapered at creases ` +
    (thickness.trim_mm > 0
      ? `and corners trimmed by ${number(thickness.trim_mm)} mm.`
      : "and no corner trimmed.")
  );
}

/** Shows the card; hidden where the report has no contact. */
export function show_contact({ contact }) {
  by_id("contact-card").hidden = contact === undefined;
  if (contact === undefined) return;
  const words = contact
    ? [first_words, unknown_words, thickness_words].map((say) => say(contact)).filter(Boolean)
    : ["Contact is unknown, since the path is lost."];
  by_id("contact").replaceChildren(...words.map((text) => h("p", {}, text)));
}
