// The candidates' table: any number of rows, of which only those in view are in the document.
import { count, h, plural } from "./format.js";
import { metrics } from "./metrics.js";
import { on_print } from "./paper.js";

const kRow_px = 28,
  kSpare = 6,
  kPrinted = 50; // rows on paper

const columns = [
  {
    name: "rank",
    label: "rank",
    unit: "",
    about: "Place in the program's order: best first.",
    width: 62,
  },
  {
    name: "draw",
    label: "draw",
    unit: "",
    about: "Number of the draw. A dot marks draws with all details in this report.",
    width: 96,
  },
  ...metrics.map((metric) => ({
    ...metric,
    width: Math.max(84, 20 + 7.3 * Math.max(metric.label.length, metric.unit.length + 2)),
  })),
];

/**
 * A grid of the candidates' rows. `order` holds the rows that pass the filter, sorted; `pick(row)`
 * is called when one is chosen.
 */
export function make_table(box, candidates, state) {
  const longest = candidates.columns.draw.reduce((most, draw) => Math.max(most, draw.length), 0);
  const present = columns
    .filter(({ name }) => name === "rank" || candidates.columns[name])
    .map((column) =>
      column.name === "draw"
        ? { ...column, width: Math.max(column.width, 44 + 8.7 * longest) }
        : column,
    );
  const template = present.map((column) => `${column.width}px`).join(" ");
  let order = [],
    sorted_by = { name: "rank", descending: false },
    passing = null;

  const heads = present.map((column) => {
    const button = h(
      "button",
      {
        type: "button",
        title: column.about,
        tabindex: -1,
        "data-sort": column.name,
        onclick: () => sort(column.name),
      },
      h("span", {}, column.label),
      h("small", {}, column.unit),
    );
    return h("div", { role: "columnheader", "data-testid": `head-${column.name}` }, button);
  });
  heads[0].firstChild.tabIndex = 0;
  const head = h(
    "div",
    { role: "row", class: "head", style: `grid-template-columns: ${template}` },
    heads,
  );
  const body = h("div", { role: "rowgroup", class: "body" });
  const grid = h(
    "div",
    {
      role: "grid",
      class: "table",
      tabindex: 0,
      "aria-label": "Candidates. Arrow keys choose a row.",
      "aria-colcount": present.length,
      "data-testid": "grid",
    },
    h("div", { role: "rowgroup", class: "heads" }, head),
    body,
  );
  box.append(grid);
  const width = present.reduce((total, column) => total + column.width, 0);
  body.style.minWidth = head.style.minWidth = `${width}px`;

  // Arrow keys go from header to header; Tab leaves them.
  head.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const at = heads.findIndex((cell) => cell.contains(document.activeElement));
    const next = heads[Math.max(0, Math.min(heads.length - 1, at + step))].firstChild;
    heads[at].firstChild.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
    event.preventDefault();
    event.stopPropagation();
  });

  const value_of = (name, row) => (name === "rank" ? row : (candidates.columns[name][row] ?? null));

  function sort(name) {
    // Up, down, and back to the program's own order.
    if (sorted_by.name !== name) sorted_by = { name, descending: false };
    else if (!sorted_by.descending) sorted_by = { name, descending: true };
    else sorted_by = { name: "rank", descending: false };
    arrange();
  }

  function arrange() {
    const { name, descending } = sorted_by,
      sign = descending ? -1 : 1;
    order = [];
    for (let row = 0; row < candidates.count; ++row) if (!passing || passing(row)) order.push(row);
    if (name === "draw") {
      const keys = candidates.columns.draw.map(BigInt);
      order.sort((a, b) => sign * (keys[a] < keys[b] ? -1 : keys[a] > keys[b] ? 1 : 0) || a - b);
    } else if (name !== "rank" || descending) {
      // What has no value comes last either way; equals keep the program's order.
      order.sort((a, b) => {
        const x = value_of(name, a),
          y = value_of(name, b);
        if (x === null || y === null) return (x === null) - (y === null) || a - b;
        return sign * (x - y) || a - b;
      });
    }
    for (const [i, column] of present.entries()) {
      const on = column.name === name;
      heads[i].setAttribute("aria-sort", on ? (descending ? "descending" : "ascending") : "none");
    }
    grid.setAttribute("aria-rowcount", order.length + 1);
    body.style.height = `${order.length * kRow_px}px`;
    state.set("order", order);
    draw(true);
  }

  let from = -1,
    to = -1,
    printing = false;
  function in_view() {
    if (printing) return [0, Math.min(order.length, kPrinted)];
    return [
      Math.max(0, Math.floor(grid.scrollTop / kRow_px) - kSpare),
      Math.min(
        order.length,
        Math.ceil((grid.scrollTop + grid.clientHeight) / kRow_px) + kSpare,
      ),
    ];
  }
  function draw(anew = false) {
    const [first, last] = in_view();
    if (!anew && first === from && last === to) return;
    [from, to] = [first, last];
    const picked = candidates.row_of.get(state.get("picked"));
    body.replaceChildren(
      ...order.slice(first, last).map((row, i) => row_node(row, first + i, row === picked)),
    );
    if (order.length === 0)
      body.append(h("p", { class: "empty" }, "No candidate meets these conditions."));
    const at = order.indexOf(picked);
    if (picked !== undefined && at >= first && at < last)
      grid.setAttribute("aria-activedescendant", `row-${row_id(picked)}`);
    else grid.removeAttribute("aria-activedescendant");
  }

  const row_id = (row) => candidates.columns.draw[row];

  function row_node(row, place, picked) {
    const draw_number = candidates.columns.draw[row],
      detailed = candidates.detailed.has(draw_number);
    return h(
      "div",
      {
        role: "row",
        id: `row-${row_id(row)}`,
        class: "line",
        "aria-rowindex": place + 2,
        "aria-selected": String(picked),
        "data-draw": draw_number,
        style: `top: ${place * kRow_px}px; grid-template-columns: ${template}`,
      },
      present.map((column) => {
        if (column.name === "rank") return h("div", { role: "gridcell" }, count(row + 1));
        if (column.name === "draw") {
          return h(
            "div",
            { role: "rowheader" },
            detailed
              ? h("span", { class: "dot", title: "with all details in this report" }, "●\u00a0")
              : null,
            draw_number,
          );
        }
        return h(
          "div",
          { role: "gridcell" },
          column.text(value_of(column.name, row)).replace(/ %$/, ""),
        );
      }),
    );
  }

  function reveal(place) {
    const top = place * kRow_px,
      bottom = top + kRow_px,
      room = grid.clientHeight - head.offsetHeight;
    if (top < grid.scrollTop) grid.scrollTop = top;
    else if (bottom > grid.scrollTop + room) grid.scrollTop = bottom - room;
  }

  grid.addEventListener("scroll", () => draw(), { passive: true });
  body.addEventListener("click", (event) => {
    const line = event.target.closest("[data-draw]");
    if (line) state.set("picked", line.dataset.draw);
  });
  grid.addEventListener("keydown", (event) => {
    if (event.target !== grid || order.length === 0) return;
    const at = order.indexOf(candidates.row_of.get(state.get("picked")));
    const page = Math.max(1, Math.floor(grid.clientHeight / kRow_px) - 2);
    const next = {
      ArrowDown: at + 1,
      ArrowUp: at < 0 ? 0 : at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: order.length - 1,
    }[event.key];
    if (next === undefined) return;
    const place = Math.max(0, Math.min(order.length - 1, next));
    state.set("picked", candidates.columns.draw[order[place]]);
    event.preventDefault();
  });
  state.on("picked", (picked) => {
    const place = order.indexOf(candidates.row_of.get(picked));
    if (place >= 0) reveal(place);
    draw(true);
  });
  new ResizeObserver(() => draw(true)).observe(grid);
  on_print((begins) => {
    printing = begins;
    draw(true);
  });

  return {
    filter(holds) {
      passing = holds;
      grid.scrollTop = 0;
      arrange();
    },
  };
}

/** The field above the table: reads conditions as they are typed, says what is wrong with them. */
export function make_filter(candidates, table, parse) {
  const field = document.getElementById("filter"),
    says = document.getElementById("filter-says");
  const read = () => {
    const text = field.value.trim(),
      parsed = parse(text, candidates);
    field.setAttribute("aria-invalid", String(Boolean(parsed.error)));
    if (parsed.error) {
      says.textContent = parsed.error;
      says.className = "error";
      return; // what was shown before stays, until the conditions can be read
    }
    table.filter(text ? parsed.holds : null);
  };
  field.addEventListener("input", read);
  document.getElementById("filter-clear").addEventListener("click", () => {
    field.value = "";
    read();
    field.focus();
  });
  const say = (order) => {
    says.className = "";
    says.textContent =
      order.length === candidates.count
        ? plural(candidates.count, "candidate")
        : `${count(order.length)} of ${plural(candidates.count, "candidate")}`;
  };
  const insert = (text) => {
    field.value = `${field.value.trim()} ${text}`.trim();
    read();
    field.focus();
  };
  const example = (text) =>
    h("button", { type: "button", class: "code", onclick: () => insert(text) }, text);
  document.getElementById("filter-help").append(
    h(
      "p",
      {},
      "Conditions side by side must all hold. A name, a comparison (< <= > >= = !=), a number; shares may be written as percentages. ",
      "Click one to try it: ",
      example("stroke_max < 5%"),
      " ",
      example("deploys_from_deg >= 172"),
      " ",
      example("150 <= deploys_from_deg < 175"),
      " ",
      example("bump_deg = none"),
      " ",
      example("increasing >= 6"),
      " ",
      example("details"),
    ),
    h(
      "dl",
      { class: "columns" },
      [["draw", "", "Number of the draw."], ...metrics.map((m) => [m.name, m.label, m.about])].map(
        ([name, label, about]) =>
          h(
            "div",
            {},
            h("dt", {}, h("code", {}, name), label ? ` ${label}` : ""),
            h("dd", {}, about),
          ),
      ),
    ),
  );
  read();
  return say;
}
