// Meshes that are compressed by Draco or meshopt are seen, and pictures in KTX2. Decoders are fetched when a file needs them.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { colorsOf, shown, variety } from "../look.mjs";

/** A square with a picture in KTX2. */
function square(picture) {
  const floats = (...numbers) => Buffer.from(new Float32Array(numbers).buffer);
  const parts = [floats(-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0), floats(0, 1, 1, 1, 1, 0, 0, 0), Buffer.from(new Uint16Array([0, 1, 2, 0, 2, 3]).buffer), picture];
  const bufferViews = parts.map((part, k) => ({ buffer: 0, byteOffset: parts.slice(0, k).reduce((sum, { length }) => sum + length, 0), byteLength: part.length }));
  const accessor = (bufferView, componentType, count, type, more = {}) => ({ bufferView, componentType, count, type, ...more });
  return JSON.stringify({
    asset: { version: "2.0" }, extensionsUsed: ["KHR_texture_basisu"], extensionsRequired: ["KHR_texture_basisu"], scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0, TEXCOORD_0: 1 }, indices: 2, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 }, metallicFactor: 0 } }],
    textures: [{ extensions: { KHR_texture_basisu: { source: 0 } } }], images: [{ mimeType: "image/ktx2", bufferView: 3 }],
    accessors: [accessor(0, 5126, 4, "VEC3", { min: [-1, -1, 0], max: [1, 1, 0] }), accessor(1, 5126, 4, "VEC2"), accessor(2, 5123, 6, "SCALAR")],
    bufferViews, buffers: [{ byteLength: parts.reduce((sum, { length }) => sum + length, 0), uri: `data:application/octet-stream;base64,${Buffer.concat(parts).toString("base64")}` }],
  });
}

const fetched = (page) => page.evaluate(() => performance.getEntriesByType("resource").map(({ name }) => name.split("/").pop().split("?")[0]));
const has = async (page, name) => (await fetched(page)).includes(name);

export async function run(page, url, ...inputs) {
  await page.goto(url);
  await shown(page, "spot.ply");
  assert.ok(!(await has(page, "demand.js")), "the first view needs no decoder");
  for (const input of inputs) {
    const [path, faces] = input.split("=");
    const files = statSync(path).isDirectory() ? readdirSync(path).map((name) => join(path, name)) : [path];
    await page.setInputFiles("#files", files);
    await shown(page, files.find((name) => /\.gl(tf|b)$/.test(name)).split("/").pop());
    assert.equal(await page.evaluate(() => window.unwrapd.viewer.analysis.faces), Number(faces), path);
    assert.ok(8 < variety(await colorsOf(page, "#solid")), `${path} is drawn`);
    assert.ok(await page.isHidden("#problem"));
  }
  assert.ok(await has(page, "draco_decoder.wasm"));
  // The service decodes KTX2.
  for (const name of ["etc1s", "uastc"]) {
    const picture = readFileSync(new URL(`../../assets/ktx2/${name}.ktx2`, import.meta.url));
    const decoded = page.waitForResponse((answer) => answer.url().endsWith("/v1/decode"));
    await page.setInputFiles("#files", { name: `${name}.gltf`, mimeType: "model/gltf+json", buffer: Buffer.from(square(picture)) });
    await shown(page, `${name}.gltf`);
    assert.equal((await decoded).status(), 200);
    await page.click("button[data-shade=material]");
    for (const pane of ["#solid", "#plane"]) assert.ok(12 < variety(await colorsOf(page, pane)), `${name} is seen in ${pane}`);
    assert.ok(await page.isHidden("#problem"));
  }
}
