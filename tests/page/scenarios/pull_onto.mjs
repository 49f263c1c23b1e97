// Charts are pulled onto another and off the page: the page says so at once, the surface beside shows it, and nothing that was proven
// of the job is taken for it. Handles survive a lost service and a reload.
import assert from "node:assert/strict";
import { colorsOf, difference, shown, variety } from "../look.mjs";
import { kill, restart } from "../service.mjs";

// A service that is gone tells in the console that it was asked for.
export const hasErrors = true;

const SOLID = "#pull-pane .pane >> nth=1";
const differing = (some, others) => some.filter((color, k) => 16 < difference(color, others[k])).length;
const grips = (page, n) => page.waitForFunction((n) => document.querySelectorAll(".grip").length === n, n);
const faults = (page, said) => page.waitForFunction((said) => new RegExp(said).test(document.querySelector("#pull-faults").textContent), said);

export async function run(page, url, picture) {
  page.on("dialog", (dialog) => dialog.accept());
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict.certified");
  // Where charts of the job are: the middles of the two of which most faces the camera, in UVs.
  const [first, second] = await page.evaluate(() => {
    const { chart, texels, drawn } = window.unwrapd.viewer.analysis;
    const eye = window.unwrapd.viewer.stage.solid.camera.position.toArray();
    const facesCamera = (k) => {
      const [a, b, c] = [0, 3, 6].map((i) => drawn.positions.slice(9 * k + i, 9 * k + i + 3));
      const minus = (p, q) => [0, 1, 2].map((axis) => p[axis] - q[axis]);
      const [u, v, w] = [minus(b, a), minus(c, a), minus(eye, a)];
      return 0 < [0, 1, 2].reduce((sum, i) => sum + w[i] * (u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]), 0);
    };
    const best = new Map();
    for (let k = 0; k < drawn.count; k++) {
      const face = drawn.face[k];
      const known = best.get(chart[face]) ?? { area: 0, largest: 0 };
      if (facesCamera(k)) known.area += Math.abs(texels[face]);
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
  // The page of UVs with a margin of 15 % and then of 8 % fills the smaller side.
  const box = await page.locator("#pull-pane .pane >> nth=0").boundingBox();
  const solid = await page.locator(SOLID).boundingBox();
  assert.deepEqual([solid.width, solid.height], [box.width, box.height], "the surface has as much room as its UVs");
  await page.selectOption("#pull-fill", "checker");
  const checker = await colorsOf(page, SOLID);
  assert.ok(4 < variety(checker), "the surface is seen");
  await page.selectOption("#pull-fill", "heat");
  assert.ok(20 < differing(await colorsOf(page, SOLID), checker), "the heat map is another fill");
  await page.selectOption("#pull-fill", "checker");
  const size = Math.min(box.width, box.height) / (1.3 * 1.08);
  const at = ([u, v]) => [box.x + box.width / 2 + (u - 0.5) * size, box.y + box.height / 2 - (v - 0.5) * size];
  await page.mouse.click(...at(first));
  await page.waitForSelector(".grip");
  await page.mouse.move(...at(second));
  await page.mouse.down();
  await page.mouse.move(...at(first), { steps: 8 });
  await page.mouse.up();
  await faults(page, "\\d+ overlap.*nearer than the padding");
  // Some ten of the hundred places that show the surface lie on the chart and change between light and dark.
  assert.ok(5 < differing(await colorsOf(page, SOLID), checker), "the checkerboard follows");
  if (picture) await page.screenshot({ path: picture });
  // Where it was, all is well again.
  await page.keyboard.press("Control+z");
  await faults(page, "^$");
  await page.mouse.move(...at(second));
  await page.mouse.down();
  await page.mouse.move(box.x + 3, box.y + 3, { steps: 8 });
  await page.mouse.up();
  await faults(page, "\\d+ faces? beyond the page");

  // The service is killed and comes back.
  await grips(page, 2);
  await kill();
  await page.waitForSelector("#pull-note >> text=Your handles are kept");
  await grips(page, 0);
  await restart();
  await grips(page, 2);
  await faults(page, "\\d+ faces? beyond the page");
  // So does the page.
  await page.reload();
  await shown(page);
  await page.waitForSelector("#pull-note >> text=2 handles");
  await page.click("#pull-start");
  await grips(page, 2);
  await faults(page, "\\d+ faces? beyond the page");
  await page.click("#pull-tools >> text=End");
  await page.waitForSelector(".verdict.certified");
}
