// Printing draws charts again, for the width of an A4 page.

const kPaper_px = 1000; // 700 between the margins of page.css: 12 px become 6 points

/** Calls listener(true) before the page is printed and listener(false) afterwards. */
export function on_print(listener) {
  addEventListener("beforeprint", () => listener(true));
  addEventListener("afterprint", () => listener(false));
}

/** The page's width on paper as a share of that on the screen. */
export const paper_share = () =>
  Math.min(1, kPaper_px / document.querySelector("main").clientWidth);
