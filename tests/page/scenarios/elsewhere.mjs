// A job that another machine runs has no charts to watch: the UV view says so, and how far it is.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  await page.waitForFunction(() => /Another machine/.test(document.getElementById("plane-note").textContent));
  const note = await page.textContent("#plane-note");
  assert.match(note, /^[A-Z][a-z ]+, [\d.]+ % done\. Another machine computes this job: its UVs appear here when it ends\.$/);
  assert.equal(await page.textContent("#relaxing"), "");
  await page.click("button:text-is('Cancel')");
  await page.waitForSelector(".verdict.cancelled");
  assert.equal(await page.textContent("#plane-note"), "No result: the job was cancelled.");
}
