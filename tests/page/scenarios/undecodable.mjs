// A picture that cannot be read is named, and the rest of the file is seen.
import assert from "node:assert/strict";
import { colorsOf, shown, variety } from "../look.mjs";
import { square } from "../square.mjs";

// Three tells of the picture in the console.
export const hasErrors = true;

export async function run(page, url) {
  await page.goto(url);
  await shown(page, "spot.ply");
  const refused = page.waitForResponse((answer) => answer.url().endsWith("/v1/decode"));
  await page.setInputFiles("#files", { name: "broken.gltf", mimeType: "model/gltf+json", buffer: Buffer.from(square(Buffer.from("no picture"))) });
  await shown(page, "broken.gltf");
  assert.ok(400 <= (await refused).status(), "the service cannot read it");
  assert.match(await page.textContent("#inspector"), /Pictures not shown\s*an embedded picture/);
  await page.click("button[data-shade=material]");
  assert.equal(await page.textContent("#legend"), "Not shown: an embedded picture");
  assert.ok(2 < variety(await colorsOf(page, "#solid")), "the square is drawn without it");
  assert.ok(await page.isHidden("#problem"));
  await page.click("button[data-shade=charts]");
  assert.ok(await page.isHidden("#legend"));
}
