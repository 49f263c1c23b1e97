// The surface is turned as in programs that people know: by a cube, and by the buttons of the mouse that they are used to.
import assert from "node:assert/strict";
import { project, settled, shown, visibleFace } from "../look.mjs";

/** The direction from the target to the camera, its distance, and the target. */
const look = (page) => page.evaluate(() => {
  const place = window.unwrapd.viewer.stage.solid.place;
  const arm = [0, 1, 2].map((k) => place[k] - place[k + 3]);
  const far = Math.hypot(...arm);
  return { from: arm.map((x) => x / far), far, at: place.slice(3) };
});
const near = (one, other) => one.every((x, k) => Math.abs(x - other[k]) < 1e-3);
const cube = (page) => page.evaluate(() => document.querySelector(".cube > div").style.transform);

async function looksFrom(page, direction) {
  await page.waitForFunction((direction) => {
    const place = window.unwrapd.viewer.stage.solid.place;
    const arm = [0, 1, 2].map((k) => place[k] - place[k + 3]);
    return arm.every((x, k) => Math.abs(x / Math.hypot(...arm) - direction[k]) < 1e-3);
  }, direction);
}

/** Drags with a button and keys held, and returns what has changed. */
async function dragged(page, button, ...held) {
  const before = await look(page);
  const { x, y, width, height } = await page.locator("#solid").boundingBox();
  for (const key of held) await page.keyboard.down(key);
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down({ button });
  await page.mouse.move(x + width / 2 + 40, y + height / 2 + 30, { steps: 4 });
  await page.mouse.up({ button });
  for (const key of held) await page.keyboard.up(key);
  await settled(page);
  const after = await look(page);
  return [!near(before.from, after.from) && "turned", !near(before.at, after.at) && "moved", 1e-3 < Math.abs(before.far / after.far - 1) && "zoomed"].filter(Boolean).join(" ");
}

async function choose(page, name) {
  await page.keyboard.press("?");
  await page.selectOption("#navigation", name);
  const said = await page.textContent(".keys");
  await page.click("#keys >> text=Close");
  return said;
}

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  // Sides of the cube that are seen can be clicked; the surface behind it is not selected.
  const { far } = await look(page);
  const first = await cube(page);
  await page.click(".cube >> text=Top");
  await looksFrom(page, [0, 1, 0]);
  await page.keyboard.press("5");
  await looksFrom(page, [1, 0, 0]);
  await page.keyboard.press("4");
  await looksFrom(page, [0, 0, 1]);
  await settled(page);
  assert.ok(Math.abs((await look(page)).far / far - 1) < 1e-3, "as far away as before");
  assert.equal(await page.evaluate(() => window.unwrapd.store.place.chart), null);
  assert.notEqual(await cube(page), first, "the cube turns");

  assert.equal(await dragged(page, "left"), "turned");
  assert.equal(await dragged(page, "right"), "moved");
  assert.match(await choose(page, "blender"), /Middle drag/);
  assert.equal(await dragged(page, "left"), "");
  assert.equal(await dragged(page, "middle"), "turned");
  assert.equal(await dragged(page, "middle", "Shift"), "moved");
  assert.equal(await dragged(page, "middle", "Control"), "zoomed");
  await page.reload();
  await shown(page);
  assert.equal(await dragged(page, "middle"), "turned", "the choice is kept");
  assert.match(await choose(page, "maya"), /Alt Drag/);
  assert.equal(await dragged(page, "left"), "");
  assert.equal(await dragged(page, "left", "Alt"), "turned");
  assert.equal(await dragged(page, "middle", "Alt"), "moved");
  assert.equal(await dragged(page, "right", "Alt"), "zoomed");
  assert.match(await choose(page, "rizom"), /Right drag/);
  assert.equal(await dragged(page, "left"), "");
  assert.equal(await dragged(page, "right"), "turned");
  assert.equal(await dragged(page, "middle"), "moved");
  await choose(page, "page");
  await framed(page);
  await limited(page);
}

/** F shows what is selected, in both views, and everything without a selection. */
async function framed(page) {
  const seen = () => page.evaluate(() => ({ solid: window.unwrapd.viewer.stage.solid.place, plane: window.unwrapd.viewer.stage.plane.place }));
  const still = async () => {
    for (let before = null, now = await seen(); JSON.stringify(before) !== JSON.stringify(now); [before, now] = [now, (await settled(page), await seen())]);
    return seen();
  };
  const far = ({ solid }) => Math.hypot(...[0, 1, 2].map((k) => solid[k] - solid[k + 3]));
  const isWithin = ([x, y], pane) => pane.x <= x && x <= pane.x + pane.width && pane.y <= y && y <= pane.y + pane.height;
  await page.keyboard.press("Escape");
  await page.keyboard.press("f");
  const all = await still();
  // A face that is clicked.
  await page.keyboard.press("1");
  const { face, plane } = await visibleFace(page);
  await page.mouse.click(...plane);
  await page.keyboard.press("f");
  const one = await still();
  assert.ok(4 * far(one) < far(all), "the camera is near the face");
  assert.ok(4 * one.plane[2] < all.plane[2], "so are the UVs");
  for (const view of ["solid", "plane"]) assert.ok(isWithin(await project(page, view, face), await page.locator(`#${view}`).boundingBox()), `it is seen in ${view}`);
  // An island: all of it is on the screen.
  await page.keyboard.press("n");
  await page.keyboard.press("f");
  await still();
  const pane = await page.locator("#plane").boundingBox();
  const places = await page.evaluate(() => {
    const { viewer } = window.unwrapd;
    return [...viewer.analysis.chart.keys()].filter((face) => viewer.analysis.chart[face] === viewer.place.chart).map((face) => viewer.project("plane", face));
  });
  assert.ok(places.length && places.every((place) => isWithin(place, pane)));
  await page.keyboard.press("1");
  await page.mouse.click(...plane);
  await page.keyboard.press("f");
  await still();
  await page.keyboard.press("Home");
  assert.ok(4 * far(one) < far(await still()), "everything is seen again");
  await page.keyboard.press("Escape");
}

/** The wheel neither leaves the scene nor enters the surface. */
async function limited(page) {
  const radius = await page.evaluate(() => window.unwrapd.viewer.model.sphere.radius);
  await page.locator("#solid").hover();
  for (const [turn, isWithin] of [[2000, (far) => far < 60 * radius], [-2000, (far) => radius / 500 < far]]) {
    for (let k = 0; k < 40; k++) await page.mouse.wheel(0, turn);
    await settled(page);
    const { far } = await look(page);
    assert.ok(isWithin(far), `${far} of ${radius}`);
  }
}
