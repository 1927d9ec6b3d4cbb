// Draws the folded sheet without WebGL, by the painter's algorithm.
import { Vector3 } from "three";
import { colour } from "./theme.js";

/** The same methods as webgl_pen. */
export function painter_pen(canvas) {
  let corners = [],
    parts = [],
    colours = [],
    drawn = null,
    ratio = 1;
  return {
    has_solids: false,
    load({ panels, parts: lines }) {
      [corners, parts] = [panels, lines];
    },
    async picture(width, height, camera, save) {
      const before = [canvas.width, canvas.height],
        usual = ratio;
      ratio *= width / canvas.width;
      [canvas.width, canvas.height] = [width, height];
      this.draw(drawn, camera);
      const saved = await save(canvas);
      ratio = usual;
      [canvas.width, canvas.height] = before;
      this.draw(drawn, camera);
      return saved;
    },
    recolour() {},
    tint(tint) {
      colours = tint?.colours ?? [];
    },
    resize(width, height) {
      ratio = Math.min(2, devicePixelRatio || 1);
      [canvas.width, canvas.height] = [width * ratio, height * ratio];
    },
    draw(points, camera) {
      drawn = points;
      const pen = canvas.getContext("2d"),
        seen = [],
        depth = [];
      for (let k = 0; 3 * k < points.length; ++k) {
        const point = new Vector3(points[3 * k], points[3 * k + 1], points[3 * k + 2]);
        depth.push(point.distanceTo(camera.position));
        point.project(camera);
        seen.push([((point.x + 1) / 2) * canvas.width, ((1 - point.y) / 2) * canvas.height]);
      }
      const mean = (list) => list.reduce((total, k) => total + depth[k], 0) / list.length;
      const items = corners.map((list, panel) => ({ list, panel, depth: mean(list) }));
      // Lines lie a little nearer than the panels they bound.
      for (const part of parts)
        if (!part.hidden)
          for (const list of part.pairs)
            items.push({ list, part, depth: part.on_top ? -1 : mean(list) * 0.98 });
      items.sort((a, b) => b.depth - a.depth);
      pen.clearRect(0, 0, canvas.width, canvas.height);
      for (const { list, part, panel } of items) {
        pen.beginPath();
        list.forEach((k, i) => (i ? pen.lineTo(...seen[k]) : pen.moveTo(...seen[k])));
        if (part) {
          pen.setLineDash(part.dashed ? [5 * ratio, 4 * ratio] : []);
          pen.lineWidth = part.width * ratio;
          pen.strokeStyle = colour(part.colour);
          pen.stroke();
        } else {
          const [a, b, c] = list.map((k) => seen[k]);
          const front = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0;
          pen.fillStyle = colours[panel] ?? colour(front ? "panel-front" : "panel-back");
          pen.closePath();
          pen.fill();
        }
      }
    },
  };
}
