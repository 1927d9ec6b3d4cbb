// Shows the table of candidates, of any number of rows: only those in view are in the document.
import { clamp, count, h, with_modifier } from "./format.js";
import { on_print } from "./paper.js";
import { csv_text, save_text } from "./save.js";
import {
  arranged,
  chosen_columns,
  is_fixed,
  order_of,
  shown,
  width_of,
  words_of,
} from "./table_columns.js";

const kRow_px = 28,
  kSpare = 6,
  kPrinted = 50; // rows on paper

/**
 * The grid of candidates, sorted by state "sort", with the columns of state "columns". It sets
 * state "order" to the rows that it shows, and "picked" to the chosen draw.
 */
class Table {
  #box;
  #candidates;
  #state;
  #present;
  #heads;
  #head;
  #body = h("div", { role: "rowgroup", class: "body" });
  #grid;
  #template;
  #order = [];
  #passing = null;
  #drawn = [-1, -1];
  #printing = false;

  constructor(box, candidates, state) {
    [this.#box, this.#candidates, this.#state] = [box, candidates, state];
    this.#build();
    this.#take_columns();
    this.#listen();
  }

  filter(holds) {
    this.#passing = holds;
    this.#grid.scrollTop = 0;
    this.#arrange();
  }

  /** Scrolls a draw's row into view, if it has one. */
  reveal(draw) {
    const place = this.#order.indexOf(this.#candidates.row_of.get(draw));
    if (place < 0) return;
    const grid = this.#grid,
      top = place * kRow_px,
      bottom = top + kRow_px,
      room = grid.clientHeight - this.#head.offsetHeight;
    if (top < grid.scrollTop) grid.scrollTop = top;
    else if (bottom > grid.scrollTop + room) grid.scrollTop = bottom - room;
  }

  #build() {
    this.#head = h("div", { role: "row", class: "head" });
    this.#grid = h(
      "div",
      {
        role: "grid",
        class: "table",
        tabindex: 0,
        "aria-label": "Candidates. Arrow keys choose a row.",
        "data-testid": "grid",
      },
      h("div", { role: "rowgroup", class: "heads" }, this.#head),
      this.#body,
    );
    const side = (way, words) =>
      h(
        "button",
        {
          type: "button",
          class: `side ${way < 0 ? "left" : "right"}`,
          title: `More columns to the ${way < 0 ? "left" : "right"}`,
          tabindex: -1,
          "aria-hidden": "true",
          onclick: () => this.#grid.scrollBy({ left: way * 0.6 * this.#grid.clientWidth }),
        },
        words,
      );
    this.#box.append(this.#grid, side(-1, "‹"), side(1, "›"));
    this.#box.classList.add("table-frame");
  }

  #take_columns() {
    this.#present = chosen_columns(this.#candidates, this.#state.get("columns"));
    const widths = this.#present.map((column) => width_of(column, this.#candidates));
    this.#template = widths.map((width) => `minmax(${width}px, ${width}fr)`).join(" ");
    this.#heads = this.#present.map((column) => this.#head_of(column));
    this.#heads[0].firstChild.tabIndex = 0;
    this.#head.replaceChildren(...this.#heads);
    this.#head.style.gridTemplateColumns = this.#template;
    this.#grid.setAttribute("aria-colcount", this.#present.length);
    const width = widths.reduce((total, part) => total + part, 0);
    this.#body.style.minWidth = this.#head.style.minWidth = `${width}px`;
  }

  // Moves a column to a place after the fixed ones.
  #move(column, place) {
    const others = this.#present.filter((other) => other !== column),
      fixed = others.filter(is_fixed).length;
    if (is_fixed(column)) return;
    others.splice(Math.max(place, fixed), 0, column);
    this.#state.set("columns", words_of(this.#candidates, others));
  }

  #head_of(column) {
    const button = h(
      "button",
      {
        type: "button",
        title: column.about,
        tabindex: -1,
        "data-sort": column.name,
        onclick: () => this.#sort(column),
      },
      h("span", {}, column.label),
      h("small", {}, column.unit),
    );
    const cell = h("div", { role: "columnheader", "data-testid": `head-${column.name}` }, button);
    if (is_fixed(column)) return cell;
    cell.draggable = true;
    cell.addEventListener("dragstart", (event) => {
      event.dataTransfer.setData("text/plain", column.name);
      event.dataTransfer.effectAllowed = "move";
    });
    cell.addEventListener("dragover", (event) => event.preventDefault());
    cell.addEventListener("drop", (event) => {
      event.preventDefault();
      const name = event.dataTransfer.getData("text/plain"),
        moved = this.#present.find((other) => other.name === name);
      if (moved) this.#move(moved, this.#present.indexOf(column));
    });
    return cell;
  }

  #listen() {
    this.#head.addEventListener("keydown", (event) => this.#step_head(event));
    this.#grid.addEventListener("keydown", (event) => this.#step_row(event));
    this.#grid.addEventListener("scroll", () => this.#scrolled(), { passive: true });
    this.#body.addEventListener("click", (event) => {
      const line = event.target.closest("[data-draw]");
      if (line) this.#state.set("picked", line.dataset.draw);
    });
    this.#body.addEventListener("pointerover", (event) =>
      this.#state.set("hovered", event.target.closest("[data-draw]")?.dataset.draw ?? null),
    );
    this.#body.addEventListener("pointerleave", () => this.#state.set("hovered", null));
    this.#state.on("picked", (picked) => {
      this.reveal(picked);
      this.#draw(true);
    });
    this.#state.on("computed", () => this.#draw(true));
    this.#state.on("columns", () => {
      this.#take_columns();
      this.#arrange();
      this.#scrolled();
    });
    this.#state.on("sort", () => {
      this.#grid.scrollTop = 0; // shows the best
      this.#arrange();
    });
    new ResizeObserver(() => {
      this.#draw(true);
      this.#scrolled();
    }).observe(this.#grid);
    let place = 0;
    on_print((begins) => {
      this.#printing = begins;
      if (begins) place = this.#grid.scrollTop;
      else this.#grid.scrollTop = place; // printing resets it
      this.#draw(true);
    });
  }

  // Arrow keys go from heading to heading, and with Alt move the column; Tab leaves them.
  #step_head(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const heads = this.#heads,
      at = heads.findIndex((cell) => cell.contains(document.activeElement));
    if (event.altKey && at >= 0) {
      const { name } = this.#present[at];
      this.#move(this.#present[at], at + step);
      const moved = this.#head.querySelector(`[data-sort="${name}"]`);
      for (const cell of this.#heads) cell.firstChild.tabIndex = cell.firstChild === moved ? 0 : -1;
      moved.focus();
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    if (with_modifier(event)) return;
    const next = heads[clamp(at + step, 0, heads.length - 1)].firstChild;
    heads[at].firstChild.tabIndex = -1;
    next.tabIndex = 0;
    next.focus();
    event.preventDefault();
    event.stopPropagation();
  }

  #step_row(event) {
    const order = this.#order;
    if (event.target !== this.#grid || order.length === 0 || with_modifier(event)) return;
    const at = order.indexOf(this.#candidates.row_of.get(this.#state.get("picked")));
    const page = Math.max(1, Math.floor(this.#grid.clientHeight / kRow_px) - 2);
    const next = {
      ArrowDown: at + 1,
      ArrowUp: at < 0 ? 0 : at - 1,
      PageDown: at + page,
      PageUp: at - page,
      Home: 0,
      End: order.length - 1,
    }[event.key];
    if (next === undefined) return;
    const place = clamp(next, 0, order.length - 1);
    this.#state.set("picked", this.#candidates.columns.draw[order[place]]);
    event.preventDefault();
  }

  // Sorts best first, at the next click worst first, then in the program's own order.
  #sort({ name, better }) {
    const best = better === "less" ? name : `-${name}`,
      worst = better === "less" ? `-${name}` : name,
      now = this.#state.get("sort") || "rank";
    this.#state.set("sort", now === best ? worst : now === worst || name === "rank" ? "" : best);
  }

  #arrange() {
    const by = order_of(this.#state.get("sort"));
    this.#order = arranged(this.#candidates, this.#passing, by);
    for (const [i, column] of this.#present.entries()) {
      const way = by.descending ? "descending" : "ascending";
      this.#heads[i].setAttribute("aria-sort", column.name === by.name ? way : "none");
    }
    this.#grid.setAttribute("aria-rowcount", this.#order.length + 1);
    this.#body.style.height = `${this.#order.length * kRow_px}px`;
    this.#state.set("order", this.#order);
    this.#draw(true);
  }

  #in_view() {
    if (this.#printing) return [0, Math.min(this.#order.length, kPrinted)];
    const { scrollTop, clientHeight } = this.#grid;
    return [
      Math.max(0, Math.floor(scrollTop / kRow_px) - kSpare),
      Math.min(this.#order.length, Math.ceil((scrollTop + clientHeight) / kRow_px) + kSpare),
    ];
  }

  #scrolled() {
    const { scrollLeft, scrollWidth, clientWidth, clientHeight, offsetWidth, offsetHeight } =
      this.#grid;
    // The width of scroll bars depends on the system: the shade ends where rows do.
    this.#box.style.setProperty("--bar-right", `${offsetWidth - clientWidth - 1}px`);
    this.#box.style.setProperty("--bar-below", `${offsetHeight - clientHeight - 1}px`);
    this.#box.classList.toggle("more-left", scrollLeft > 1);
    this.#box.classList.toggle("more-right", scrollLeft + clientWidth < scrollWidth - 1);
    this.#draw();
  }

  #draw(anew = false) {
    const [first, last] = this.#in_view();
    if (!anew && first === this.#drawn[0] && last === this.#drawn[1]) return;
    this.#drawn = [first, last];
    const picked = this.#candidates.row_of.get(this.#state.get("picked"));
    this.#body.replaceChildren(
      ...this.#order
        .slice(first, last)
        .map((row, i) => this.#row_node(row, first + i, row === picked)),
    );
    if (this.#order.length === 0)
      this.#body.append(h("p", { class: "empty" }, "No candidate meets the conditions."));
    const at = this.#order.indexOf(picked);
    if (picked !== undefined && at >= first && at < last)
      this.#grid.setAttribute(
        "aria-activedescendant",
        `row-${this.#candidates.columns.draw[picked]}`,
      );
    else this.#grid.removeAttribute("aria-activedescendant");
  }

  #row_node(row, place, picked) {
    const draw = this.#candidates.columns.draw[row];
    return h(
      "div",
      {
        role: "row",
        id: `row-${draw}`,
        class: "line",
        "aria-rowindex": place + 2,
        "aria-selected": String(picked),
        "data-draw": draw,
        style: `top: ${place * kRow_px}px; grid-template-columns: ${this.#template}`,
      },
      this.#present.map((column) => this.#cell(column, row, draw)),
    );
  }

  #cell(column, row, draw) {
    if (column.name === "rank") return h("div", { role: "gridcell" }, count(row + 1));
    if (column.name === "draw") {
      const dot = h("span", { class: "dot", title: "all details in this report" }, "●\u00a0");
      return h(
        "div",
        { role: "rowheader" },
        this.#candidates.detailed.has(draw) ? dot : null,
        draw,
      );
    }
    const value = this.#candidates.columns[column.name][row] ?? null,
      bad = value !== null && column.warns?.(value);
    return h("div", { role: "gridcell", class: bad ? "bad" : null }, shown(column, value));
  }
}

export const make_table = (box, candidates, state) => new Table(box, candidates, state);

/** Saves the rows that the table shows, in its order, with all columns. */
export function save_rows(candidates, order, name) {
  const heads = Object.keys(candidates.columns);
  const rows = order.map((row) => heads.map((head) => candidates.columns[head][row] ?? null));
  save_text(csv_text({ heads, rows }), "text/csv", `${name}-candidates.csv`);
}
