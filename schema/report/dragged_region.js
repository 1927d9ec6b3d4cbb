// Shows the rectangle that a pointer drags over a canvas.
import { h } from "./format.js";

const kLeast_px = 8; // of both sides; a smaller one is a click

/**
 * Calls taken({ left, right, top, bottom }) in the canvas's px after a drag. Returns whether the
 * latest press was a drag, as a function: a click follows each.
 */
export function follow_drags(canvas, taken) {
  const box = h("div", { class: "region", hidden: true });
  canvas.after(box);
  let start = null,
    is_drag = false;
  const place = (event) => {
    const frame = canvas.getBoundingClientRect();
    return [event.clientX - frame.left, event.clientY - frame.top];
  };
  const region = ([x, y]) => ({
    left: Math.min(x, start[0]),
    right: Math.max(x, start[0]),
    top: Math.min(y, start[1]),
    bottom: Math.max(y, start[1]),
  });
  const end = () => {
    start = null;
    box.hidden = true;
  };
  canvas.addEventListener("pointerdown", (event) => {
    is_drag = false;
    if (event.button !== 0 || event.pointerType === "touch") return; // a finger scrolls the page
    canvas.setPointerCapture(event.pointerId);
    start = place(event);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!start) return;
    const { left, right, top, bottom } = region(place(event));
    is_drag ||= right - left >= kLeast_px && bottom - top >= kLeast_px;
    box.hidden = !is_drag;
    Object.assign(box.style, {
      left: `${left}px`,
      top: `${top}px`,
      width: `${right - left}px`,
      height: `${bottom - top}px`,
    });
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!start) return;
    const dragged = region(place(event));
    end();
    const is_large =
      dragged.right - dragged.left >= kLeast_px && dragged.bottom - dragged.top >= kLeast_px;
    if (is_drag && is_large) taken(dragged);
  });
  canvas.addEventListener("pointercancel", end);
  return () => is_drag;
}
