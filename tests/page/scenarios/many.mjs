// What many opened jobs leave on the GPU is no more than what the first ones do.
import assert from "node:assert/strict";
import { fill, settled, shown } from "../look.mjs";

// Three rounds of three jobs and four fills.
const OPENED = 36;
/** Fills one after the other, so that each meets each job. */
const FILLS = ["charts", "material", "padding", "heat"];

export async function run(page, url, ...ids) {
  await page.goto(url);
  await shown(page);
  const seen = [];
  for (let k = 0; k < OPENED; k++) {
    await page.click(`#job-list li[data-id="${ids[k % ids.length]}"] a`);
    await page.waitForFunction((id) => window.unwrapd.store.job?.id === id, ids[k % ids.length]);
    await page.waitForSelector(".verdict");
    await shown(page);
    await fill(page, FILLS[k % FILLS.length]);
    await settled(page);
    seen.push(await page.evaluate(() => ({ ...window.unwrapd.viewer.stage.renderer.info.memory })));
  }
  // Jobs and fills come again in the same pairs. Whether a model was drawn before its analysis was ready, and so is on the GPU
  // in another fill, is a matter of time, but the most of a round is not.
  const round = ids.length * FILLS.length;
  const most = (from) => ["geometries", "textures"].map((what) => Math.max(...seen.slice(from, from + round).map((one) => one[what])));
  assert.deepEqual(most(OPENED - round), most(round), JSON.stringify(seen));
  return { first: seen[round], last: seen.at(-1), most: most(OPENED - round) };
}
