// Before and after side by side: one camera, one scale, and as much room.
import assert from "node:assert/strict";
import { colorsOf, difference, fill, settled, shown, variety } from "../look.mjs";

const PANES = ["#solid", "#plane", "#solid-beside", "#plane-beside"];
const geometries = (page) => page.evaluate(() => window.unwrapd.viewer.stage.renderer.info.memory.geometries);
const both = (page) => page.waitForSelector("#panes.both").then(() => settled(page));

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  await fill(page, "heat");
  await page.locator("#plane").hover();
  await page.keyboard.press("d");
  await both(page);
  const boxes = await Promise.all(PANES.map((pane) => page.locator(pane).boundingBox()));
  for (const { width, height } of boxes) assert.ok(200 < width && 200 < height, `${width} by ${height}`);
  assert.equal(new Set(boxes.map(({ width, height }) => `${Math.round(width)} ${Math.round(height)}`)).size, 1);
  const before = await Promise.all(PANES.map((pane) => colorsOf(page, pane)));
  before.forEach((seen, k) => assert.ok(3 < variety(seen), `${PANES[k]} is empty`));
  const differing = (one, other) => one.filter((color, k) => 24 < difference(color, other[k])).length;
  assert.ok(10 < differing(before[1], before[3]), "the layouts differ");
  assert.match(await page.textContent("#legend"), /before: mean .* %/);

  // Whichever pane is dragged, the other of its kind follows.
  for (const [k, from] of [[0, "#solid-beside"], [1, "#plane-beside"]]) {
    const box = await page.locator(from).boundingBox();
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 70, y + 10, { steps: 4 });
    await page.mouse.up();
    for (const pane of [PANES[k], from]) assert.ok(10 < differing(await colorsOf(page, pane), before[PANES.indexOf(pane)]), `${pane} moved`);
  }
  // The address says so, and the GPU forgets what is not seen.
  await page.reload();
  await shown(page);
  await both(page);
  const held = await geometries(page);
  for (let k = 0; k < 2; k++) {
    await page.click("text=Side by side");
    await page.waitForSelector("#panes:not(.both)");
    await shown(page);
    await page.click("text=Side by side");
    await both(page);
  }
  // Who changes their mind sees what they asked for last.
  for (let k = 0; k < 3; k++) await page.keyboard.press("d");
  await page.waitForLoadState("networkidle");
  await shown(page);
  assert.equal(await page.locator("#panes.both").count(), 0);
  await page.keyboard.press("d");
  await both(page);
  const now = await geometries(page);
  assert.ok(now <= held, `${now} geometries, ${held} before`);
}
