// Saves the numbers and pictures of the selected draw's charts as files.
import { actuation_rows } from "./actuation.js";
import { label_of } from "./data.js";
import { by_id } from "./format.js";
import { history_rows } from "./histories.js";
import { add_saving, single } from "./save.js";
import { file_stem } from "./page_kind.js";

/** Vertices of the flat sheet and their shifts, mm. */
function flat_rows({ sheet }, { displacements_mm }) {
  return {
    heads: ["vertex", "x_mm", "y_mm", "dx_mm", "dy_mm"],
    rows: sheet.vertices_mm.map(([x, y], k) => {
      const [dx, dy] = displacements_mm[label_of(k)] ?? [0, 0];
      return [label_of(k), x + dx, y + dy, dx, dy];
    }),
  };
}

/** Vertices in space at a sample, from the middle of the flat sheet. */
function folded_rows(decoded, sample) {
  const { vertex_count, vertices_mm } = decoded,
    first = sample * vertex_count;
  return {
    heads: ["vertex", "x_mm", "y_mm", "z_mm"],
    rows: Array.from({ length: vertex_count }, (_, k) => [
      label_of(k),
      ...Array.from(vertices_mm.subarray(3 * (first + k), 3 * (first + k + 1)), single),
    ]),
  };
}

/** Adds buttons to every card of the picked draw that has a picture. */
export function save_details(report, detail, decoded, state, crease_drawing) {
  const stem = file_stem(report, detail.draw);
  const card_of = (id) => by_id(id).closest(".card"),
    plot_of = (id) => () => by_id(id).querySelector("svg.plot");
  add_saving(card_of("crease"), {
    name: `${stem}-crease-pattern`,
    csv: () => flat_rows(report, detail),
    svg: () => crease_drawing,
  });
  add_saving(card_of("folding"), {
    name: () => `${stem}-folded-${state.get("pilot_deg")}deg`,
    csv: () => folded_rows(decoded, state.get("sample")),
  });
  add_saving(card_of("histories"), {
    name: `${stem}-diagonals`,
    csv: () => history_rows(report, decoded),
    svg: plot_of("histories"),
  });
  for (const id of ["energy", "moment", "advantage"]) {
    add_saving(card_of(id), {
      name: `${stem}-${id}`,
      csv: () => actuation_rows(id, decoded),
      svg: plot_of(id),
    });
  }
}
