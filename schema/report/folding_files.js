// Saves the folding picture: as PNG up to 7,680 px wide, as glTF, and as a film of one deployment.
import { Group, Mesh, MeshStandardMaterial } from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { clamp, h } from "./format.js";
import { download } from "./save.js";
import { colour } from "./theme.js";

const kWidths_px = [1280, 1920, 3840, 7680],
  kFilm_s = 6,
  kRest_s = 0.8,
  kFrames_per_s = 30,
  kMetres_per_mm = 1e-3;

/** Copies of a mesh without instances, by which few programs read glTF. */
function plain_meshes(mesh) {
  const { color, opacity, transparent, vertexColors, side } = mesh.material;
  return Array.from({ length: mesh.isInstancedMesh ? mesh.count : 1 }, (_, i) => {
    const look = { color, opacity, transparent, vertexColors, side, roughness: 0.8 },
      copy = new Mesh(mesh.geometry, new MeshStandardMaterial(look));
    if (!mesh.isInstancedMesh) return copy;
    copy.matrixAutoUpdate = false;
    mesh.getMatrixAt(i, copy.matrix);
    if (mesh.instanceColor) mesh.getColorAt(i, copy.material.color);
    return copy;
  });
}

/** The sheet as binary glTF: in metres, y upwards. */
async function gltf_of(solids) {
  const sheet = new Group().add(...solids.flatMap(plain_meshes));
  sheet.name = "sheet";
  sheet.scale.setScalar(kMetres_per_mm);
  sheet.rotation.x = -Math.PI / 2;
  return new GLTFExporter().parseAsync(sheet, { binary: true });
}

/** A canvas of constant even size that shows another one on the ground of its card. */
function film_canvas(shown) {
  const ratio = Math.min(2, devicePixelRatio || 1),
    even = (size) => 2 * Math.round((size * ratio) / 2),
    canvas = h("canvas", { width: even(shown.clientWidth), height: even(shown.clientHeight) }),
    pen = canvas.getContext("2d", { alpha: false });
  const copy = () => {
    pen.fillStyle = colour("card");
    pen.fillRect(0, 0, canvas.width, canvas.height);
    pen.drawImage(shown, 0, 0, canvas.width, canvas.height);
  };
  return { canvas, copy };
}

/** Records one deployment from `first` to flat, as long as it goes on, then shows the sheet at rest again. */
async function film_of(shown, { first, pose, goes_on, pause }) {
  pause();
  const { canvas, copy } = film_canvas(shown);
  const recorder = new MediaRecorder(canvas.captureStream(kFrames_per_s), {
    mimeType: "video/webm",
    videoBitsPerSecond: 8e6,
  });
  const parts = [];
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  const ended = new Promise((done) => recorder.addEventListener("stop", done, { once: true }));
  recorder.start();
  const begun = performance.now();
  await new Promise((done) => {
    const step = (now) => {
      const time_s = (now - begun) / 1000,
        part = clamp((time_s - kRest_s) / kFilm_s, 0, 1);
      if (goes_on()) {
        pose(first * (1 - part));
        copy();
      }
      if (time_s > kFilm_s + 2 * kRest_s || !goes_on()) done();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  recorder.stop();
  await ended;
  if (goes_on()) pose(null);
  return new Blob(parts, { type: "video/webm" });
}

/**
 * The menu of files. `view` has pen, camera, canvas, stem() and pose_stem() (of the names),
 * range() (see film_of), and record(on), during which it is drawn out of sight, too.
 */
export function folding_files(view) {
  const width = h(
    "select",
    { "aria-label": "Width of the picture in pixels", "data-testid": "picture-width" },
    kWidths_px.map((px) => h("option", { value: px, selected: px === 1920 }, `${px} px`)),
  );
  const says = h("span", { class: "note", role: "status" });
  const button = (words, title, id, save) =>
    h(
      "button",
      {
        type: "button",
        title,
        "data-testid": id,
        onclick: async (event) => {
          const { target } = event;
          target.disabled = true;
          says.textContent = words === "Film" ? "recording …" : "";
          view.record(true);
          try {
            await save();
          } finally {
            view.record(false);
            says.textContent = "";
            target.disabled = false;
          }
        },
      },
      words,
    );
  const png = () => {
    const wide = Number(width.value);
    return view.pen.picture(wide, Math.round(wide / view.camera.aspect), view.camera, (canvas) =>
      new Promise((done) => canvas.toBlob(done, "image/png")).then((blob) =>
        download(blob, `${view.pose_stem()}.png`),
      ),
    );
  };
  const gltf = async () =>
    download(
      new Blob([await gltf_of(view.pen.solids)], { type: "model/gltf-binary" }),
      `${view.pose_stem()}.glb`,
    );
  const film = async () =>
    download(await film_of(view.canvas, view.range()), `${view.stem()}-deployment.webm`);
  const can_film = "MediaRecorder" in window && MediaRecorder.isTypeSupported("video/webm");
  return h(
    "details",
    { class: "view-files" },
    h("summary", { "data-testid": "view-files" }, "Save"),
    h(
      "div",
      {},
      h("div", { class: "row" }, button("PNG", "Picture as PNG", "folding-png", png), width),
      view.pen.has_solids
        ? button("glTF", "Folded sheet as binary glTF, in metres", "folding-gltf", gltf)
        : null,
      can_film ? button("Film", "One deployment as WebM", "folding-film", film) : null,
      says,
    ),
  );
}
