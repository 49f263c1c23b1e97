// What is on screen is what is unwrapped, and what a person has set survives other jobs, results and a reload.
import assert from "node:assert/strict";
import { settled, shown } from "../look.mjs";

const camera = (page) => page.evaluate(() => window.unwrapd.viewer.stage.solid.place.map((x) => Number(x.toPrecision(4))));
const geometries = (page) => page.evaluate(() => window.unwrapd.viewer.stage.renderer.info.memory.geometries);
const jobs = (page) => page.locator("#job-list .row-link");

async function turn(page, dx) {
  const box = await page.locator("#solid").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + 20, { steps: 4 });
  await page.mouse.up();
  await settled(page);
  return camera(page);
}

/** Opens a listed job and waits for its result. */
async function openJob(page, name) {
  await page.click(`#job-list .row-link:has-text("${name}")`);
  await page.waitForSelector(".verdict");
  await page.waitForFunction((stem) => window.unwrapd.viewer.facts?.source.name === `${stem}.glb` && document.querySelector("#panes").dataset.shown, name.split(".")[0]);
  await settled(page);
}

export async function run(page, url, mesh, listed, other, switches = "6") {
  await page.goto(url);
  await shown(page, "spot.ply");
  // The options are not fetched before someone looks at them.
  assert.ok(!(await page.evaluate(() => performance.getEntriesByType("resource").some(({ name }) => name.endsWith("openapi.json")))));
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
  await page.click("button[data-shade=checker]");
  await page.selectOption("#resolution", "512");

  // A listed job is on screen, and is run again with the options of the form.
  await openJob(page, listed);
  assert.equal(await page.textContent("#submit"), "Unwrap again");
  assert.match(await page.textContent("#target"), new RegExp(listed));
  const before = await turn(page, 90);
  const count = await jobs(page).count();
  await page.click("#submit");
  await page.waitForFunction((count) => document.querySelectorAll("#job-list .row-link").length === count, count + 1);
  await page.waitForSelector(".verdict.certified");
  await page.waitForFunction(() => window.unwrapd.store.job?.options.resolution === 512 && document.querySelector("#panes").dataset.shown);
  await settled(page);
  assert.equal(await page.textContent("#title"), listed);
  assert.deepEqual(await camera(page), before, "the result is seen as the job before");
  const again = new URL(page.url()).hash;

  // Another job has a camera of its own; fill and options are a person's.
  await openJob(page, other);
  assert.notDeepEqual(await camera(page), before);
  const elsewhere = await turn(page, -60);
  await openJob(page, listed);
  assert.deepEqual(await camera(page), before, "a job is seen as it was left");
  await openJob(page, other);
  assert.deepEqual(await camera(page), elsewhere);
  assert.equal(await page.getAttribute("button[data-shade=checker]", "aria-pressed"), "true");
  assert.equal(await page.inputValue("#resolution"), "512");

  // Fill and options survive a visit to the bare address.
  await page.goto(url);
  await page.reload();
  await shown(page, "spot.ply");
  assert.equal(await page.inputValue("#resolution"), "512");
  assert.equal(await page.getAttribute("button[data-shade=checker]", "aria-pressed"), "true");
  await page.goto(`${url}${again}`);
  await page.reload();
  await page.waitForSelector(".verdict");
  await settled(page);
  assert.equal(await page.textContent("#title"), listed);

  // The GPU holds the shown model alone.
  await openJob(page, other);
  const held = await geometries(page);
  for (let k = 0; k < Number(switches) / 2; k++) {
    await openJob(page, listed);
    await openJob(page, other);
  }
  assert.equal(await geometries(page), held);
  return { geometries: held };
}
