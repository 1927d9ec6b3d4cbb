// Measures the width of texts before they are in the document.

const pen = document.createElement("canvas").getContext("2d");
let family = null;

/** Width in px of a text in the page's font. */
export function text_width(text, size_px, weight = 400) {
  family ??= getComputedStyle(document.body).fontFamily;
  pen.font = `${weight} ${size_px}px ${family}`;
  return pen.measureText(text).width;
}
