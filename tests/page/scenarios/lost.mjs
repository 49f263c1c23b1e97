// A lost graphics device is replaced by pictures until it is back.
import assert from "node:assert/strict";
import { colorsOf, settled, shown, variety } from "../look.mjs";

export const hasErrors = true;

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  const before = variety(await colorsOf(page, "#plane"));
  await page.evaluate(() => {
    window.lose = window.unwrapd.viewer.stage.renderer.getContext().getExtension("WEBGL_lose_context");
    window.lose.loseContext();
  });
  await page.waitForSelector("#fallback:not([hidden]) img");
  assert.match(await page.textContent("#fallback"), /graphics device was lost/);
  await page.evaluate(() => window.lose.restoreContext());
  await page.waitForSelector("#fallback", { state: "hidden" });
  await settled(page);
  assert.ok(before / 2 < variety(await colorsOf(page, "#plane")), "the views are back");
}
