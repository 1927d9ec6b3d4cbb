// Keeps the selected draw, its angle, filter, order and columns in the page's address, after the #. So a link,
// a reload or the back button shows them again, also on a page opened from a file.

const kQuiet_ms = 300; // faster changes are one step of the back button
const kNames = {
  draw: "picked",
  filter: "filter",
  sort: "sort",
  across: "across",
  up: "up",
  columns: "columns",
  beside: "beside",
  at: "at",
};

/** The hash of all values that differ from the page's first. */
function hash_of(state, beginning) {
  const words = new URLSearchParams();
  for (const [key, name] of Object.entries(kNames)) {
    const value = state.get(name);
    if (value !== null && value !== beginning[name]) words.set(key, value);
  }
  return String(words);
}

/** The hash's parameters; null where it names a section. */
function read_hash() {
  const text = location.hash.slice(1);
  if (text !== "" && !text.includes("=")) return null;
  return new URLSearchParams(text);
}

/** The draw that the address names, or null. */
export const draw_in_address = () => read_hash()?.get("draw") ?? null;

/** Makes links to sections scroll without changing the address. */
function keep_anchors_out() {
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    link.addEventListener("click", (event) => {
      const section = document.getElementById(link.hash.slice(1));
      if (!section) return;
      event.preventDefault();
      section.scrollIntoView();
      section.tabIndex = -1;
      section.focus({ preventScroll: true });
    });
  }
}

/**
 * Sets the state from the address, now and whenever it changes, and the address from the state.
 * `first` is the draw that a page without an address shows.
 * `knows(name, value)` returns whether the page has it; `complain(words)` shows what it lacks,
 * complain("") nothing; `restored()` is called after each setting.
 */
export function follow_address(state, { first, knows, complain, restored }) {
  const names = Object.values(kNames);
  const beginning = {
    ...Object.fromEntries(names.map((name) => [name, state.get(name)])),
    picked: first,
  };
  let written = hash_of(state, beginning),
    picked = state.get("picked"),
    timer = 0;

  function restore() {
    const words = read_hash();
    if (!words) return;
    const strangers = [];
    for (const [key, name] of Object.entries(kNames)) {
      const value = words.get(key);
      if (value !== null && !knows(name, value)) strangers.push(`${key} ${value}`);
      else state.set(name, value ?? beginning[name]);
    }
    complain(
      strangers.length
        ? `The address names what this report does not have: ${strangers.join(", ")}.`
        : "",
    );
    restored();
    clearTimeout(timer);
    written = hash_of(state, beginning);
    picked = state.get("picked");
  }

  function write() {
    const text = hash_of(state, beginning);
    if (text === written) return;
    // Only another draw is a step of the back button; a filter or an order is not.
    const way = state.get("picked") === picked ? "replaceState" : "pushState";
    history[way](null, "", location.href.split("#")[0] + (text ? `#${text}` : ""));
    [written, picked] = [text, state.get("picked")];
    complain("");
  }

  keep_anchors_out();
  restore();
  for (const name of names) {
    state.on(name, () => {
      clearTimeout(timer);
      timer = setTimeout(write, kQuiet_ms);
    });
  }
  addEventListener("popstate", restore);
}
