// Several files at once, the list, and what can be done with jobs.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url, ...meshes) {
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", meshes);
  assert.equal(await page.locator("#chosen li").count(), meshes.length);
  assert.equal(await page.textContent("#submit"), `Unwrap ${meshes.length} files`);
  await page.click("label[for=purpose-few]");
  await page.selectOption("#resolution", "2048");
  await page.click("#submit");
  const names = meshes.map((mesh) => mesh.split("/").pop());
  for (const name of names) await page.waitForSelector(`#job-list .facts.certified >> nth=${names.indexOf(name)}`);
  const rows = await page.locator("#job-list .name").allTextContents();
  assert.deepEqual(rows.toSorted(), names.toSorted());
  await page.click(`.row-link:has-text("${names[0]}")`);
  await page.waitForSelector(".verdict");
  await shown(page);
  assert.match(await page.textContent("#inspector"), /quality few, resolution 2048/);
  await page.click("text=Copy as command");
  await page.waitForSelector("text=Copied");
  const line = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(line, /^unwrapd unwrap \S+ -o \S+\.glb --quality few --resolution 2048$/);
  await page.click("text=Copy as curl");
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /^curl -s http/);
  await page.click("#inspector >> text=Delete");
  await shown(page);
  await page.waitForFunction((count) => document.querySelectorAll(".row-link").length === count, names.length - 1);
  return { line };
}
