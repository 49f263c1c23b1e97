// A job that another machine runs has no charts to watch: the UV view says so, and how far it is.
import assert from "node:assert/strict";

export async function run(page, url) {
  // The mesh is large so that the job is mapped for a while, not to be looked at.
  await page.route(/\/inputs\//, (route) => route.abort());
  await page.goto(url);
  await page.waitForFunction(() => /Another machine/.test(document.getElementById("plane-note").textContent));
  const note = await page.textContent("#plane-note");
  assert.match(note, /^[A-Z][a-z ]+, [\d.]+ % done\. Another machine computes this job: its UVs appear here when it ends\.$/);
  assert.equal(await page.textContent("#relaxing"), "");
}
