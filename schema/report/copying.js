// Copies texts to the clipboard.
import { by_id, h } from "./format.js";

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Pages opened from a file may be denied the clipboard: execCommand needs a selected field.
    const field = h("textarea", { class: "sr" });
    field.value = text;
    document.body.append(field);
    field.select();
    document.execCommand("copy");
    field.remove();
  }
}

export const copy_button = (text, words = "Copy") => {
  const button = h("button", { type: "button", "data-testid": "copy" }, words);
  let timer = 0;
  button.addEventListener("click", async () => {
    await copy(text);
    button.textContent = "Copied";
    by_id("said").textContent = "Copied";
    clearTimeout(timer);
    timer = setTimeout(() => {
      button.textContent = words;
      by_id("said").textContent = ""; // the next one is said, too
    }, 1200);
  });
  return button;
};

/** Words in elements of their own: lines break between them, and not behind a hyphen. */
export const unbroken = (text) =>
  text.split(" ").flatMap((word, i) => [i > 0 ? " " : null, h("span", {}, word)]);
