// The picked draw's crease pattern, as figure 12b of the paper: mountains, valleys, holes, their
// diagonals with numbers, and the shifts as arrows, much enlarged.
import { ends_of, label_of } from "./data.js";
import { h } from "./format.js";
import { line, panel_size_mm, polygon, sheet_svg } from "./sheet.js";

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

export function show_crease_pattern(box, caption, report, detail, decoded, state) {
  const { sheet, diagonals } = report,
    size = panel_size_mm(sheet);
  const shift_of = (k) => detail.displacements_mm[label_of(k)] ?? [0, 0];
  const at = sheet.vertices_mm.map(([x, y], k) => [x + shift_of(k)[0], y + shift_of(k)[1]]);
  const longest = Math.max(
    0,
    ...Object.values(detail.displacements_mm).map((shift) => Math.hypot(...shift)),
  );
  const scale = arrow_scale(longest, size);
  const svg = sheet_svg(
    at,
    0.32 * size,
    "Crease pattern: mountains dash-dotted red, valleys dashed blue, holes hatched, diagonals numbered, shifts as arrows",
  );
  svg.style.setProperty("--size", size.toFixed(2));
  const pattern = h(
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
  );
  const head = h(
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
  );
  svg.append(h("svg:defs", {}, pattern, head));
  for (const panel of sheet.panels) svg.append(polygon(panel, at, { class: "panel" }));
  for (const hole of sheet.holes) svg.append(polygon(hole.corners, at, { class: "hole" }));
  const stroke = (a, b, attributes) => svg.append(line(at[a], at[b], attributes));
  for (const [a, b] of sheet.cuts) stroke(a, b, { class: "cut" });
  const dash = (parts) => parts.map((part) => (part * size).toFixed(2)).join(" ");
  for (const { a, b, assignment } of sheet.creases) {
    stroke(a, b, {
      class: assignment,
      "stroke-dasharray":
        assignment === "mountain" ? dash([0.17, 0.045, 0.03, 0.045]) : dash([0.1, 0.06]),
    });
  }
  const [p, q] = sheet.pilot;
  stroke(p, q, { class: "pilot-crease" });

  const lines = diagonals.map((diagonal, d) => {
    const [a, b] = [at[diagonal.from_vertex], at[diagonal.to_vertex]];
    const name = `${diagonal.from}–${diagonal.to}`;
    // Numbers stand off the crossing, each towards the end where its diagonal begins.
    const where = [a[0] + 0.27 * (b[0] - a[0]), -(a[1] + 0.27 * (b[1] - a[1]))];
    const group = h(
      "svg:g",
      { class: `diagonal ${decoded.grows[d] ? "grows" : "shrinks"}`, "data-diagonal": d },
      h(
        "svg:title",
        {},
        `diagonal ${d + 1}: ${name}, ${decoded.grows[d] ? "increasing" : "decreasing"} as it folds`,
      ),
      line(a, b, { class: "reach" }),
      line(a, b, {
        class: "stroke",
        "stroke-dasharray": decoded.grows[d] ? null : dash([0.05, 0.035]),
      }),
      h("svg:text", { x: where[0].toFixed(2), y: where[1].toFixed(2) }, String(d + 1)),
    );
    group.addEventListener("pointerenter", () => state.set("diagonal", d));
    group.addEventListener("pointerleave", () => state.set("diagonal", null));
    svg.append(group);
    return group;
  });

  for (const k of sheet.ball_joints)
    svg.append(h("svg:circle", { cx: at[k][0], cy: -at[k][1], r: 0.028 * size, class: "ball" }));
  const label = (k, shift) => {
    // Opposite the arrow, so that neither covers the other.
    const away = Math.hypot(...shift) || 1,
      x = at[k][0] - (shift[0] / away) * 0.17 * size,
      y = -at[k][1] + (shift[1] / away) * 0.17 * size;
    svg.append(
      h(
        "svg:text",
        { x: x.toFixed(2), y: (y + 0.045 * size).toFixed(2), class: "vertex-label" },
        label_of(k),
      ),
    );
  };
  for (const [name, shift] of Object.entries(detail.displacements_mm)) {
    const k = ends_of(name)[0],
      tip = [at[k][0] + scale * shift[0], at[k][1] + scale * shift[1]];
    if (!shift[0] && !shift[1]) continue;
    svg.append(
      h(
        "svg:line",
        {
          x1: at[k][0].toFixed(2),
          y1: (-at[k][1]).toFixed(2),
          x2: tip[0].toFixed(2),
          y2: (-tip[1]).toFixed(2),
          class: "arrow",
          "marker-end": "url(#arrow-head)",
        },
        h("svg:title", {}, `${name} shifted by (${shift[0]}, ${shift[1]}) mm`),
      ),
    );
    label(k, shift);
  }
  const legend = h(
    "ul",
    { class: "legend crease-legend" },
    [
      ["mountain", "mountain"],
      ["valley", "valley"],
      ["cut", "cut"],
      ["grows", "increasing diagonal"],
      ["shrinks", "decreasing diagonal"],
      ["pilot-crease", "pilot crease"],
    ].map(([kind, words]) =>
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
  box.replaceChildren(svg, legend);
  caption.textContent =
    `Flat sheet seen from above (+z). Shifts drawn ×${scale.toLocaleString("en")} (longest: ${longest.toFixed(2)} mm); ` +
    "numbers name the diagonals of the holes, circles are ball joints.";
  return (picked) => {
    svg.classList.toggle("has-picked", picked !== null);
    lines.forEach((group, d) => group.classList.toggle("picked", d === picked));
  };
}
