// A texture has any size, and is seen as it is filled: charts with their padding, at each of its mip levels.
import assert from "node:assert/strict";
import { colorsOf, settled, shown, variety } from "../look.mjs";

const place = (page) => page.evaluate(() => window.unwrapd.store.place);
const isEmpty = ([r, g, b]) => Math.max(r, g, b) < 40;
const empty = async (page) => (await colorsOf(page, "#plane", 48)).filter(isEmpty).length;

async function set(page, field, value) {
  await page.fill(field, String(value));
  await page.press(field, "Enter");
  await settled(page);
}

export async function run(page, url, mesh) {
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
  // A size of the list, another one by hand, and back.
  assert.ok(await page.isHidden("#size"));
  await page.selectOption("#resolution", "other");
  await set(page, "#size", "300 × 200");
  assert.equal(await page.evaluate(() => document.querySelector("#size").validity.customError), true, "the service takes no such sides");
  await set(page, "#size", "300 × 150");
  assert.equal(await page.evaluate(() => window.unwrapd.store.state.options.resolution), "300x150");
  await page.reload();
  await shown(page);
  assert.equal(await page.inputValue("#size"), "300 × 150");
  await page.selectOption("#resolution", "512");
  assert.ok(await page.isHidden("#size"));
  await page.selectOption("#resolution", "other");
  await set(page, "#size", "300x150");
  await page.setInputFiles("#files", mesh);
  await page.click("#submit");
  await page.waitForSelector(".verdict");
  await shown(page);
  assert.equal(await page.evaluate(() => window.unwrapd.store.job.options.resolution), "300x150");

  // More padding leaves fewer texels empty.
  await page.click("button[data-shade=padding]");
  const padding = Number(await page.inputValue("#gutter"));
  assert.match(await page.textContent("#legend"), /300 × 150 texels/);
  await set(page, "#gutter", 0);
  const [none, own] = [await empty(page), (await set(page, "#gutter", padding), await empty(page))];
  const wide = (await set(page, "#gutter", padding + 12), await empty(page));
  assert.ok(wide < own && own < none, `${none} empty places without padding, ${own} with ${padding} texels, ${wide} with more`);
  // Coarse levels mix what lies around a chart into it.
  await set(page, "#gutter", padding);
  const fine = variety(await colorsOf(page, "#solid"));
  await set(page, "#mip", 5);
  assert.match(await page.textContent("#legend"), /9 × 4 texels/);
  assert.ok(fine < variety(await colorsOf(page, "#solid")), "colors are mixed on the surface");
  assert.ok((await empty(page)) < own, "texels that nothing reached are mixed, too");
  assert.equal((await place(page)).mip, 5);
  // The address opens the same state.
  await page.reload();
  await shown(page);
  assert.equal(await page.inputValue("#mip"), "5");
  await page.click("button[data-shade=charts]");
  assert.equal(await page.evaluate(() => window.unwrapd.viewer.stage.uniforms.uShade.value), 1);
}
