// Options are saved under names, applied and deleted, and survive a reload.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

const form = (page) => page.evaluate(() => {
  const { kind, options } = window.unwrapd.store.state;
  return { kind, options };
});
const presets = (page) => page.locator("#saved option").allTextContents();

export async function run(page, url) {
  await page.goto(url);
  await shown(page, "spot.ply");
  assert.ok(await page.isHidden("#saved"));
  await page.click("label[for=purpose-lightmap]");
  await page.selectOption("#resolution", "2048");
  await page.click("#more summary");
  await page.waitForSelector("#options .option");
  await page.fill("#option-padding", "8");
  assert.ok(await page.isDisabled("#save-preset"));
  const lightmap = { kind: "unwrap", options: { preset: "lightmap", resolution: 2048, padding: 8 } };
  await page.fill("#preset-name", "Lightmap 2k");
  await page.press("#preset-name", "Enter");
  assert.deepEqual(await form(page), lightmap);
  assert.equal(await page.inputValue("#saved"), "Lightmap 2k");
  assert.equal(await page.locator(".row-link").count(), 0, "no job is made");

  // Another one, of another kind. The list says which one the form agrees with.
  await page.click("#reset");
  assert.equal(await page.inputValue("#saved"), "");
  await page.selectOption("#kind", "measure");
  await page.fill("#preset-name", "Check");
  await page.click("#save-preset");
  assert.deepEqual(await presets(page), ["Defaults", "Check", "Lightmap 2k"]);
  await page.reload();
  await shown(page, "spot.ply");
  assert.equal(await page.inputValue("#saved"), "Check");
  await page.selectOption("#saved", "Lightmap 2k");
  assert.deepEqual(await form(page), lightmap);
  assert.ok(await page.isChecked("#purpose-lightmap"));
  assert.equal(await page.inputValue("#resolution"), "2048");
  // A changed option is no longer the preset, until it is saved under the name again.
  await page.selectOption("#resolution", "4096");
  assert.equal(await page.inputValue("#saved"), "");
  await page.click("#more summary");
  await page.fill("#preset-name", "Lightmap 2k");
  await page.click("#save-preset");
  assert.equal(await page.inputValue("#saved"), "Lightmap 2k");
  await page.click("#delete-preset");
  assert.deepEqual(await presets(page), ["–", "Check"]);
  assert.equal((await form(page)).options.resolution, 4096, "the options stay");
  await page.reload();
  await shown(page, "spot.ply");
  assert.deepEqual(await presets(page), ["–", "Check"]);
}
