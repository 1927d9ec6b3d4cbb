// Builds one self-contained page: bundles main.js, and puts it and page.css into page.html.
//
//   node build.mjs OUTPUT.html [DIRECTORY]      DIRECTORY holds node_modules; default: this one
import { createHash } from "node:crypto";
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [output, directory = here] = process.argv.slice(2);
if (!output) {
  console.error("usage: node build.mjs OUTPUT.html [DIRECTORY with node_modules]");
  process.exit(2);
}
const esbuild = createRequire(join(resolve(directory), "package.json"))("esbuild");

const options = {
  bundle: true,
  minify: true,
  write: false,
  target: "es2022",
  legalComments: "none",
  nodePaths: [join(resolve(directory), "node_modules")],
};
const bundled = (file, extra) =>
  esbuild.build({ ...options, ...extra, entryPoints: [join(here, file)] });

/** The licences of the packages in the bundle, which copies must carry. */
function licences(inputs) {
  const packages = new Set();
  for (const input of Object.keys(inputs)) {
    const name = /node_modules\/((?:@[^/]+\/)?[^/]+)\/(?!.*node_modules\/)/.exec(input)?.[1];
    if (name) packages.add(name);
  }
  return [...packages]
    .sort()
    .map((name) => {
      const root = join(resolve(directory), "node_modules", name);
      const file =
        existsSync(root) && readdirSync(root).find((entry) => /^licen[cs]e/i.test(entry));
      return `${name}\n\n${file ? readFileSync(join(root, file), "utf8").trim() : "(no licence file)"}\n`;
    })
    .join("\n----\n\n");
}

// Escapes what would end the page's tags early.
const code = await bundled("main.js", { format: "iife", charset: "utf8", metafile: true });
const script = code.outputFiles[0].text
  .trim()
  .replaceAll(/<\/(script)/gi, "<\\/$1")
  .replaceAll("<!--", "<\\!--");
const style = (await bundled("page.css", {})).outputFiles[0].text
  .trim()
  .replaceAll(/<\/(style)/gi, "<\\/$1");
const notices = licences(code.metafile.inputs).replaceAll("<", "&lt;");

// The hash lets no other script run in the page.
const hash = `sha256-${createHash("sha256").update(script).digest("base64")}`;

const page = readFileSync(join(here, "page.html"), "utf8")
  .replace("@SCRIPT_HASH@", () => hash)
  .replace("/* page.css */", () => style)
  .replace("/* main.js */", () => script)
  .replace("<!-- licences -->", () => notices);
for (const place of ["@REPORT_SERVER@", "@REPORT_WORDS@", "@REPORT_DATA@"])
  if (page.split(place).length !== 2) throw new Error(`${place} must occur exactly once`);
writeFileSync(output, page);
