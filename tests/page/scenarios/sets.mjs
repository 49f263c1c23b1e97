// Another UV set of a file is chosen, seen, and opened again by its address.
import assert from "node:assert/strict";
import { colorsOf, difference, fill, shown } from "../look.mjs";

/** How far the UVs that are shown reach. */
const bounds = (page) => page.evaluate(() => window.unwrapd.viewer.analysis.atlases[0].bounds);

function assertNear(some, others) {
  assert.ok(difference(some, others) < 1e-3, `${some} is not ${others}`);
}

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  assert.deepEqual(await page.locator("#set option").allTextContents(), ["UV set 0", "UV set 1", "UV set 2 · new"]);
  assert.equal(await page.inputValue("#set"), "2");
  await fill(page, "plain");
  const written = await colorsOf(page, "#plane");
  // The bounds that the file states, v turned up.
  await choose(page, "1");
  assertNear(await bounds(page), [0, 0.75, 0.25, 1]);
  const other = await colorsOf(page, "#plane");
  assert.ok(20 < written.filter((color, k) => 16 < difference(color, other[k])).length, "the UVs on the page changed");
  assert.ok(await page.isDisabled("#arrange"), "what no job made is not arranged");
  assert.match(page.url(), /set=1/);
  await page.reload();
  await shown(page);
  assert.equal(await page.inputValue("#set"), "1");
  assertNear(await bounds(page), [0, 0.75, 0.25, 1]);
  await page.keyboard.press("t");
  await page.waitForFunction(() => document.getElementById("set").value === "2");
  await shown(page);
  assert.doesNotMatch(page.url(), /set=/);
  // Those of the source: it has no third set.
  await page.click("button:text-is('Before')");
  await page.waitForFunction(() => document.querySelectorAll("#set option").length === 2);
  await shown(page);
  assertNear(await bounds(page), [8.66e-5, 8.66e-5, 0.749957, 0.999913]);
  await choose(page, "1");
  assertNear(await bounds(page), [0, 0.75, 0.25, 1]);
}

async function choose(page, set) {
  await page.selectOption("#set", set);
  await page.waitForFunction((set) => window.unwrapd.viewer.facts?.set === Number(set), set);
  await shown(page);
}
