// Without WebGL, pictures and the report are there all the same.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export const flags = ["--disable-3d-apis"];
export const hasErrors = true;

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  assert.equal(await page.evaluate(() => window.unwrapd.viewer.stage), null);
  assert.equal(await page.locator("#fallback img").count(), 2);
  assert.match(await page.textContent("#fallback"), /no WebGL/);
  await page.click("#tab-report");
  await page.waitForSelector(".certificate");
  assert.equal(await page.locator(".histogram").count(), 4);
}
