// The address opens the same state.
import assert from "node:assert/strict";
import { settled, shown, visibleFace } from "../look.mjs";

const state = (page) => page.evaluate(() => {
  const { place, stage } = window.unwrapd.viewer;
  const { camera, plane, ...rest } = place;
  return { ...rest, selected: stage.uniforms.uSelected.value.toArray(), camera: stage.solid.place.map((x) => Number(x.toPrecision(3))), plane: stage.plane.place.map((x) => Number(x.toPrecision(3))) };
});

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  await page.click("button[data-shade=heat]");
  await page.selectOption("#measure", "area");
  await page.click("button[data-switch=wire]");
  const { plane } = await visibleFace(page);
  await page.mouse.click(...plane);
  await page.mouse.wheel(0, -300);
  const box = await page.locator("#solid").boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.mouse.down();
  await page.mouse.move(box.x + 160, box.y + 120, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  await page.waitForFunction(() => {
    const written = new URLSearchParams(location.hash.slice(1));
    const { solid, plane } = window.unwrapd.viewer.stage;
    const isWritten = (name, place) => String(place.map((x) => Number(x.toPrecision(5)))) === written.get(name);
    return isWritten("camera", solid.place) && isWritten("plane", plane.place);
  });
  const before = await state(page);
  assert.notEqual(before.chart, null);
  await page.reload();
  await shown(page);
  assert.deepEqual(await state(page), before);
  assert.equal(await page.getAttribute("button[data-shade=heat]", "aria-pressed"), "true");
  await page.click("#tab-report");
  await page.waitForSelector(".certificate");
  await page.reload();
  await page.waitForSelector(".certificate");
  // Back leads to where one was.
  await page.click(".row-link >> nth=0");
  assert.ok(await page.isVisible("#report"));
}
