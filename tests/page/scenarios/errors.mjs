// What goes wrong is said where one looks, and what to do.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export const hasErrors = true;

export async function run(page, url) {
  const alert = () => page.waitForSelector("#problem:not([hidden])").then((shown) => shown.textContent());
  await page.goto(`${url}#job=01a00000-0000-7000-8000-000000000000`);
  assert.match(await alert(), /never existed|deleted/);

  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", { name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("no mesh") });
  assert.match(await alert(), /Choose GLB/);
  await page.click("#problem button");
  assert.ok(await page.isHidden("#problem"));

  const broken = JSON.stringify({ asset: { version: "2.0" }, meshes: [{ primitives: [{ attributes: { POSITION: 7 } }] }] });
  await page.setInputFiles("#files", { name: "broken.gltf", mimeType: "model/gltf+json", buffer: Buffer.from(broken) });
  assert.match(await alert(), /cannot read|no triangles/);
  await page.click("#submit");
  await page.waitForSelector(".verdict.failed");
  assert.match(await page.textContent(".failure"), /Repair the file/);
  // The cause is explained, and the job may be tried again or removed.
  const link = await page.getAttribute(".failure a", "href");
  assert.match(link, /^docs#\w+$/);
  assert.ok(await page.isVisible("text=Retry"));
  await page.click("#inspector >> text=Delete");
  // The chosen file is still chosen, and still cannot be shown.
  assert.match(await alert(), /cannot read|no triangles/);
  assert.match(await page.textContent("#chosen"), /broken\.gltf/);
  await page.click("#problem button");

  // A service that does not answer is told from one that refuses.
  await page.route("**/v1/jobs", (route) => route.abort());
  await page.click("#submit");
  assert.match(await alert(), /does not answer/);
}
