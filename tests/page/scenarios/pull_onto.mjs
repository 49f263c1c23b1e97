// A chart that is pulled onto another: the page says so at once, and takes nothing that was proven of the job for it.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url, picture) {
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict.certified");
  // Where charts of the job are: the middles of the two largest, in UVs.
  const [first, second] = await page.evaluate(() => {
    const { chart, texels, drawn } = window.unwrapd.viewer.analysis;
    const best = new Map();
    for (let k = 0; k < drawn.count; k++) {
      const face = drawn.face[k];
      const known = best.get(chart[face]) ?? { area: 0, sum: [0, 0], n: 0, face, largest: 0 };
      known.area += Math.abs(texels[face]);
      const middle = [0, 1].map((axis) => [0, 2, 4].reduce((sum, i) => sum + drawn.uvs[6 * k + axis + i], 0) / 3);
      if (known.largest < Math.abs(texels[face])) Object.assign(known, { largest: Math.abs(texels[face]), middle });
      best.set(chart[face], known);
    }
    return [...best.values()].sort((one, other) => other.area - one.area).slice(0, 2).map(({ middle }) => middle);
  });
  for (const width of [959, 390, 1280]) {
    await page.setViewportSize({ width, height: 800 });
    await page.click("#tab-pull");
    const box = await page.locator("#pull-pane").boundingBox();
    assert.ok(200 < box.height && 200 < box.width, `${width}: ${JSON.stringify(box)}`);
    await page.click("#tab-view");
  }
  await page.click("#tab-pull");
  await page.selectOption("#pull-way", { label: "UVs" });
  await page.click("#pull-start");
  await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
  assert.ok(!(await page.isVisible(".verdict")), "nothing is certified of what is pulled");
  assert.match(await page.textContent("#pull-facts"), /Nothing is proven/);
  assert.equal(await page.textContent("#pull-faults"), "");
  // The page of UVs with a margin of 15 % fills the smaller side.
  const box = await page.locator("#pull-pane .pane:visible").boundingBox();
  const size = Math.min(box.width, box.height) / 1.3;
  const at = ([u, v]) => [box.x + box.width / 2 + (u - 0.5) * size, box.y + box.height / 2 - (v - 0.5) * size];
  await page.mouse.click(...at(first));
  await page.waitForSelector(".grip");
  await page.mouse.move(...at(second));
  await page.mouse.down();
  await page.mouse.move(...at(first), { steps: 20 });
  await page.mouse.up();
  await page.waitForFunction(() => /\d+ overlap/.test(document.querySelector("#pull-faults").textContent));
  if (picture) await page.screenshot({ path: picture });
  // Where it was, all is well again.
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => document.querySelector("#pull-faults").textContent === "");
  await page.click("#pull-tools >> text=End");
  await page.waitForSelector(".verdict.certified");
}
