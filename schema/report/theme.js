// Switches between light and dark: the system's preference, or the reader's choice, which is
// stored.
import { on_print } from "./paper.js";

const kKey = "misalign-theme";
const listeners = [];
let printing = false;

function stored() {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

const prefers_dark = () => matchMedia("(prefers-color-scheme: dark)").matches;
let chosen = stored();

function current() {
  if (printing) return "light";
  return chosen ?? (prefers_dark() ? "dark" : "light");
}

function apply() {
  document.documentElement.dataset.theme = current();
  for (const listener of listeners) listener();
}

/** Calls a listener when colours have changed, so that canvases are drawn again. */
export const on_theme = (listener) => listeners.push(listener);

/** The present value of a colour of page.css, for canvases. */
export const colour = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export function set_up_theme(button) {
  apply();
  const label = () => {
    const next = current() === "dark" ? "light" : "dark";
    button.textContent = next === "dark" ? "◐ Dark" : "◑ Light";
    button.setAttribute("aria-label", `Change to ${next} colours`);
  };
  label();
  button.addEventListener("click", () => {
    chosen = current() === "dark" ? "light" : "dark";
    try {
      localStorage.setItem(kKey, chosen);
    } catch {
      // A page opened from a file may have no storage.
    }
    apply();
    label();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    apply();
    label();
  });
  // Paper is white: canvases cannot follow a print style sheet, so they are drawn again.
  on_print((begins) => {
    printing = begins;
    apply();
  });
}
