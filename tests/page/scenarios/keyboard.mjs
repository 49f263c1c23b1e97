// A whole run by the keyboard alone: unwrap, look, select, save, arrange, bake. No pointer is moved.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { settled, shown } from "../look.mjs";

const place = (page, name) => page.evaluate((name) => window.unwrapd.store.place[name], name);
const focus = (page) => page.evaluate(() => document.activeElement.id);

/** Presses Tab until an element has the focus. */
async function tabTo(page, id, key = "Tab", most = 20) {
  for (let k = 0; k < most; k++) {
    await page.keyboard.press(key);
    if ((await focus(page)) === id) return;
  }
  throw new Error(`${id} is not reached by ${key}`);
}

export async function run(page, url, mesh) {
  const press = (key) => page.keyboard.press(key);
  await page.goto(url);
  await shown(page, "spot.ply");
  const asked = page.waitForEvent("filechooser");
  // The first stop leads past the form.
  await press("Tab");
  assert.equal(await focus(page), "skip");
  await press("Enter");
  assert.equal(await focus(page), "plane");
  await press("o");
  await (await asked).setFiles(mesh);
  await shown(page, mesh.split("/").pop());
  await press("u");
  await page.waitForSelector(".verdict.certified");
  await shown(page);
  await looked(page, press);
  await saved(page, press);
  await tabs(page, press);
  await arranged(page, press);
}

/** Cameras follow the arrow keys, plus and minus; islands are selected one after the other. */
async function looked(page, press) {
  const seen = () => page.evaluate(() => {
    const { solid, plane } = window.unwrapd.viewer.stage;
    return { solid: solid.place, plane: plane.place };
  });
  await page.evaluate(() => document.getElementById("plane").focus());
  const first = await seen();
  await press("ArrowRight");
  await press("ArrowUp");
  await press("+");
  const moved = await seen();
  assert.deepEqual(moved.solid, first.solid);
  assert.ok(first.plane[0] < moved.plane[0] && first.plane[1] < moved.plane[1] && moved.plane[2] < first.plane[2], `${moved.plane}`);
  await tabTo(page, "solid", "Shift+Tab");
  await press("ArrowRight");
  await press("ArrowUp");
  await press("-");
  const turned = await seen();
  assert.deepEqual(turned.plane, moved.plane);
  const arm = ({ solid }) => [0, 1, 2].map((k) => solid[k] - solid[k + 3]);
  assert.ok(Math.hypot(...arm(first)) * 1.2 < Math.hypot(...arm(turned)), "the camera is farther away");
  const angle = (view) => Math.atan2(arm(view)[0], arm(view)[2]);
  assert.ok(Math.abs(angle(turned) - angle(first) - Math.PI / 12) < 1e-6, "it has turned by 15 degrees");
  await press("n");
  assert.equal(await place(page, "chart"), 0);
  await press("n");
  assert.equal(await page.textContent("#pointed"), "Chart 2 is selected");
  await press("Shift+N");
  await press("Shift+N");
  assert.notEqual(await place(page, "chart"), 0, "the last island comes before the first one");
  await press("v");
  await page.waitForFunction((before) => String(window.unwrapd.viewer.stage.solid.place) !== before, String(turned.solid));
  await press("f");
  await settled(page);
}

async function saved(page, press) {
  const [download] = await Promise.all([page.waitForEvent("download"), press("s")]);
  assert.match(download.suggestedFilename(), /\.glb$/);
  assert.ok(0 < statSync(await download.path()).size);
}

/** Tabs are one stop, and the arrow keys go from one to the next. */
async function tabs(page, press) {
  await tabTo(page, "tab-view", "Shift+Tab", 60);
  await press("ArrowRight");
  assert.equal(await focus(page), "tab-report");
  await page.waitForSelector(".certificate");
  await press("ArrowLeft");
  assert.equal(await focus(page), "tab-view");
  assert.ok(await page.isVisible("#panes"));
}

/** An island is selected, scaled by a typed factor and baked. */
async function arranged(page, press) {
  await page.evaluate(() => document.getElementById("solid").focus());
  await press("Shift+Tab");
  assert.equal(await focus(page), "arrange");
  await press("Enter");
  await tabTo(page, "plane");
  await press("n");
  const island = () => page.evaluate(() => document.getElementById("panes").dataset.selected);
  const first = await island();
  await press("n");
  assert.notEqual(await island(), first);
  await press("Shift+N");
  assert.equal(await island(), first);
  // The last island is the smallest: in place, it can shrink into no other.
  await press("Shift+N");
  assert.notEqual(await island(), first);
  for (const key of ["s", ".", "9", "Enter"]) await press(key);
  await page.waitForFunction(() => !document.querySelector("#arrange-bake").disabled);
  const job = await place(page, "job");
  await press("b");
  await page.waitForFunction((job) => window.unwrapd.store.place.job !== job, job);
  await page.waitForSelector(".verdict");
  assert.match(await page.textContent("#inspector .verdict h2"), /^Certified$/);
}
