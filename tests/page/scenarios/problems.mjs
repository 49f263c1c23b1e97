// Overlaps and islands that are too near are red, and counted.
import assert from "node:assert/strict";
import { colors, project, shown } from "../look.mjs";

export async function run(page, url, overlapping, near, clean) {
  await page.goto(url);
  await shown(page);
  const { atlases } = await page.evaluate(() => ({ atlases: window.unwrapd.viewer.analysis.atlases }));
  assert.equal(atlases[0].overlapping, 1);
  assert.match(await page.textContent("#faults"), /1 overlap/);
  const at = async (face) => (await colors(page, [await project(page, "plane", Number(face))]))[0];
  const isRed = ([red, green]) => green + 90 < red;
  assert.ok(isRed(await at(overlapping)), "an overlap is red");
  assert.ok(!isRed(await at(clean)), "a good face is not");
  await page.click("button[data-switch=problems]");
  assert.ok(!isRed(await at(overlapping)), "unless problems are hidden");
  assert.equal(atlases[0].near, 2, `the faces beside the gap: ${near}`);
}
