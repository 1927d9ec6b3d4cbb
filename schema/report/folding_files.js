// Saves the folding picture: as PNG up to 7,680 px wide, as glTF, and as a film of one deployment.
import {
  BufferGeometry,
  Color,
  Float32BufferAttribute,
  Group,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
} from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { clamp, h } from "./format.js";
import { download } from "./save.js";

const kWidths_px = [1280, 1920, 3840, 7680],
  kFilm_s = 6,
  kRest_s = 0.8,
  kFrames_per_s = 30,
  kMetres_per_mm = 1e-3;

/** A mesh without instances, its colours at its corners. */
function plain_mesh(mesh) {
  const count = mesh.isInstancedMesh ? mesh.count : 1,
    whole = mesh.geometry.index ? mesh.geometry.toNonIndexed() : mesh.geometry,
    positions = [],
    normals = [],
    colours = [],
    matrix = new Matrix4(),
    colour = new Color();
  for (let i = 0; i < count; ++i) {
    const part = whole.clone();
    if (mesh.isInstancedMesh) {
      mesh.getMatrixAt(i, matrix);
      part.applyMatrix4(matrix);
    }
    const corners = part.attributes.position.count;
    for (const value of part.attributes.position.array) positions.push(value);
    for (const value of part.attributes.normal.array) normals.push(value);
    if (part.attributes.color) for (const value of part.attributes.color.array) colours.push(value);
    else {
      if (mesh.instanceColor) mesh.getColorAt(i, colour);
      else colour.copy(mesh.material.color);
      for (let n = 0; n < corners; ++n) colours.push(colour.r, colour.g, colour.b);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  geometry.setAttribute("normal", new Float32BufferAttribute(normals, 3));
  geometry.setAttribute("color", new Float32BufferAttribute(colours, 3));
  const { opacity, transparent } = mesh.material;
  return new Mesh(
    geometry,
    new MeshStandardMaterial({ vertexColors: true, roughness: 0.8, opacity, transparent }),
  );
}

/** The sheet as binary glTF: in metres, y upwards. */
async function gltf_of(solids) {
  const sheet = new Group().add(...solids.map(plain_mesh));
  sheet.name = "sheet";
  sheet.scale.setScalar(kMetres_per_mm);
  sheet.rotation.x = -Math.PI / 2;
  return new GLTFExporter().parseAsync(sheet, { binary: true });
}

/** Records one deployment from `first` to flat, as long as it goes on, then shows `shown` again. */
async function film_of(canvas, { first, shown, pose, goes_on, pause }) {
  pause();
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
      if (goes_on()) pose(first * (1 - part));
      if (time_s > kFilm_s + 2 * kRest_s || !goes_on()) done();
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  });
  recorder.stop();
  await ended;
  if (goes_on()) pose(shown);
  return new Blob(parts, { type: "video/webm" });
}

/**
 * The menu of files. `view` has pen, camera, canvas, stem() and pose_stem() (of the names), and
 * range() (see film_of).
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
          try {
            await save();
          } finally {
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
