// Meshes that are compressed by Draco or meshopt are seen, and pictures in KTX2. Decoders are fetched when a file needs them.
import assert from "node:assert/strict";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { square } from "../square.mjs";
import { colorsOf, shown, variety } from "../look.mjs";

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
