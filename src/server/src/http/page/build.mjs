// Builds the pages into a folder: `node build.mjs dist`. Equal sources make equal bytes.
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const into = process.argv[2];
mkdirSync(into, { recursive: true });

const shared = {
  absWorkingDir: here, bundle: true, minify: true, format: "esm", target: "es2023", charset: "utf8", legalComments: "eof",
  logLevel: "warning",
};

/** Returns a name that changes with the content; the service tells browsers to cache it for good. */
function versioned(name, content) {
  return `${name}?v=${createHash("sha256").update(content).digest("hex").slice(0, 16)}`;
}

async function bundle(entry, define = {}) {
  const { outputFiles } = await build({ ...shared, entryPoints: [entry], define, write: false });
  return outputFiles[0].contents;
}

/** Bundles the page in three parts: its start, what is fetched when it is needed, and what both have in common. */
async function page(define) {
  const { outputFiles } = await build({
    ...shared, entryPoints: { page: "app/main.ts" }, splitting: true, chunkNames: "[name]", outdir: "assets", define, write: false,
  });
  const text = Object.fromEntries(outputFiles.map(({ path, text }) => [basename(path), text]));
  const parts = {};
  // Each names the parts before it.
  for (const name of ["chunk.js", "demand.js", "page.js"]) {
    parts[name] = text[name].replaceAll(/"\.\/(chunk|demand)\.js"/g, (_, part) => {
      if (!parts[`${part}.js`]) throw new Error(`${name} must not import ${part}.js: what both parts of the page need cannot fetch the second one`);
      return JSON.stringify(`./${versioned(`${part}.js`, parts[`${part}.js`])}`);
    });
  }
  return parts;
}

const made = { "worker.js": await bundle("analysis/worker.ts") };
Object.assign(made, await page({ WORKER: JSON.stringify(versioned("worker.js", made["worker.js"])) }));
made["docs.js"] = await bundle("docs/main.ts");
made["page.css"] = await bundle("page.css");
made["docs.css"] = await bundle("docs.css");
const viewer = join(here, "node_modules/swagger-ui-dist");
// The decoder of Draco as three.js ships it, and its terms: the Apache License 2.0, whose text comes with the viewer.
const draco = join(here, "node_modules/three/examples/jsm/libs/draco");
for (const name of ["draco_wasm_wrapper.js", "draco_decoder.wasm"]) made[name] = readFileSync(join(draco, "gltf", name));
made["decoders.txt"] = [join(draco, "README.md"), join(viewer, "LICENSE")].map((path) => readFileSync(path, "utf8")).join("\n");
const terms = ["NOTICE", "LICENSE", "swagger-ui-es-bundle.js.LICENSE.txt"];
made["viewer.txt"] = terms.map((name) => readFileSync(join(viewer, name), "utf8")).join("\n");
for (const page of ["index.html", "docs.html"]) {
  const html = readFileSync(join(here, page), "utf8");
  made[page] = html.replace(/assets\/([\w.]+)/g, (_, name) => `assets/${versioned(name, made[name])}`);
}
for (const [name, content] of Object.entries(made)) writeFileSync(join(into, name), content);
