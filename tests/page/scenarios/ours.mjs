// Camera and fill are the person's: the result of what is looked at is seen from the same side. Its end is no start.
import assert from "node:assert/strict";
import { settled, shown } from "../look.mjs";

export async function run(page, url, mesh) {
  // The panel is looked at after the job has ended and before its result is there.
  let go = () => {};
  const gone = new Promise((done) => { go = done; });
  await page.route(/\/v1\/jobs\/[^/]+\/report/, async (route) => {
    await gone;
    await route.continue();
  });
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", mesh);
  const name = mesh.split("/").pop();
  await shown(page, name);
  await page.click("button[data-shade=checker]");
  const box = await page.locator("#solid").boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 150, box.y + box.height / 2 + 40, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  const camera = () => page.evaluate(() => window.unwrapd.viewer.stage.solid.place);
  const before = await camera();
  await page.click("#submit");
  await page.waitForFunction(() => document.querySelector(".progress-panel .stage")?.textContent === "Fetching the result" || document.querySelector(".verdict"));
  if (await page.isVisible(".progress-panel")) {
    for (const action of ["Finish early", "Cancel"]) assert.ok(await page.isDisabled(`.progress-panel button:text-is("${action}")`), action);
    assert.ok(!/Starting/.test(await page.textContent(".progress-panel")), "the end is no start");
  }
  go();
  await page.waitForSelector(".verdict");
  await page.waitForFunction(() => window.unwrapd.viewer.facts?.source.name.endsWith(".glb"));
  await settled(page);
  const after = await camera();
  after.forEach((x, k) => assert.ok(Math.abs(x - before[k]) < 1e-3 * Math.hypot(...before), `${after} is not ${before}`));
  assert.equal(await page.evaluate(() => window.unwrapd.viewer.place.shade), "checker");
  assert.ok(!(await page.evaluate(() => window.unwrapd.viewer.stage.solid.isTurning)));
  // A job that is removed leaves the chosen file.
  await page.click("#inspector >> text=Delete");
  await shown(page, name);
  assert.match(await page.textContent("#chosen"), new RegExp(name.replace(".", "\\.")));
}
