// One file after the other: nothing of the former is said of the next, and no file breaks the page.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { archive } from "../archive.mjs";
import { settled, shown } from "../look.mjs";

// Three tells of the pictures that a lone glTF lacks.
export const hasErrors = true;

export async function run(page, url, mesh, other) {
  const missing = [];
  page.on("response", (answer) => {
    if (answer.status() === 404) missing.push(answer.url());
  });
  const choose = (...files) => page.setInputFiles("#files", files);
  const file = (name, from) => ({ name, mimeType: "application/octet-stream", buffer: typeof from === "string" ? Buffer.from(from) : from });
  const [good, second] = [mesh, other].map((path) => readFileSync(path));
  const problem = () => page.waitForSelector("#problem:not([hidden])");
  await page.goto(url);
  await shown(page, "spot.ply");
  const faces = await page.textContent("#inspector");

  // A file that cannot be read: its error is said, and nothing of the file before.
  await choose(file("broken.ply", "no mesh"));
  await problem();
  assert.ok(!(await page.textContent("#inspector")).includes("Surface area"), await page.textContent("#inspector"));
  assert.match(await page.textContent("#inspector"), /broken\.ply/);
  // Nothing turns where nothing is.
  await page.waitForFunction(async () => {
    const { figures } = window.unwrapd.viewer.stage;
    const before = figures.frames;
    await new Promise((over) => setTimeout(over, 400));
    return figures.frames === before;
  });
  assert.ok(faces.includes("Surface area"));
  // The next one is good, and so is what is said of it.
  await choose(file("good.obj", good));
  await shown(page, "good.obj");
  assert.ok(await page.isHidden("#problem"));

  // A body has no surface to unwrap, which is no alarm: it can be pulled.
  await choose(file("solid.msh", "$MeshFormat"));
  await page.waitForSelector("#tab-pull[aria-selected=true]");
  await page.waitForFunction(() => document.querySelector("#title").textContent === "solid.msh");
  assert.ok(await page.isHidden("#problem"));
  await page.click("#tab-view");
  // What a lone glTF references is not asked of the service.
  const lone = { asset: { version: "2.0" }, meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0, accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: "VEC3" }], bufferViews: [{ buffer: 0, byteLength: 36 }], buffers: [{ byteLength: 36, uri: "lone.bin" }] };
  await choose(file("lone.gltf", JSON.stringify(lone)));
  await page.waitForFunction(() => document.querySelector("#plane-note").textContent.includes("lone.bin"));
  assert.deepEqual(missing, []);

  // A mesh in an archive is seen and unwrapped.
  await choose(file("mesh.zip", archive([{ name: "in/good.obj", content: good }])));
  await shown(page, "good.obj");
  assert.ok(await page.isHidden("#problem"));
  await page.click("#submit");
  await page.waitForSelector(".verdict.certified");
  assert.equal(await page.textContent("#title"), "good.obj");

  // A long name and an option that is set leave the panel as wide as it is.
  const long = "MetalRoughSpheresWithoutTexturesAndWithAVeryLongNameThatGoesOn.obj";
  await choose(file(long, good), file("second.ply", second));
  await shown(page, long);
  await page.click("#more summary");
  await page.waitForSelector("#option-padding");
  await page.fill("#option-padding", "3");
  // The jobs are in reach beside all options; the rare ones are found by a search.
  assert.ok((await page.locator("#jobs-title").boundingBox()).y < 780);
  assert.ok(await page.isHidden("#option-barrier_support"));
  await page.fill("#find-option", "inverse-spline");
  assert.ok(await page.isVisible("#option-barrier_support"));
  assert.ok(await page.isHidden("#option-padding"));
  await page.fill("#find-option", "no option has this");
  assert.ok(await page.isVisible("text=No option has these words"));
  await page.fill("#find-option", "");
  const spread = await page.evaluate(() => {
    const side = document.querySelector("#side");
    const right = side.getBoundingClientRect().right;
    const shownOnes = [...side.querySelectorAll("button, input, select")].filter((one) => one.offsetParent && one.getBoundingClientRect().width > 1);
    return { over: side.scrollWidth - side.clientWidth, out: shownOnes.filter((one) => right < one.getBoundingClientRect().right).map((one) => one.id || one.textContent) };
  });
  assert.deepEqual(spread, { over: 0, out: [] });

  // Neither do they make the page of a phone wider.
  await page.setViewportSize({ width: 390, height: 844 });
  assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
  await page.setViewportSize({ width: 1280, height: 800 });

  // A chosen file can be looked at, and the one that is looked at can be taken out.
  await page.click("#chosen >> text=second.ply");
  await shown(page, "second.ply");
  await page.click("#chosen button[aria-label='Remove second.ply']");
  await shown(page, long);
  assert.equal(await page.textContent("#title"), long);

  // An option that is wrong is shown, wherever it is.
  await page.fill("#option-padding", "-3");
  await page.fill("#find-option", "seam");
  await page.click("#more summary");
  await page.click("#submit");
  await page.waitForSelector("#more[open]");
  assert.equal(await page.evaluate(() => document.activeElement.id), "option-padding");
  assert.ok(!(await page.locator("#option-cut option").allTextContents()).includes("seams"), "no list of seams can be given here");
  await page.fill("#option-padding", "");

  // What is on the GPU does not grow with what is switched.
  const geometries = () => page.evaluate(() => window.unwrapd.viewer.stage.renderer.info.memory.geometries);
  await page.click("button[data-switch=wire]");
  await page.click("button[data-switch=wire]");
  await settled(page);
  const before = await geometries();
  for (let k = 0; k < 20; k++) await page.click("button[data-switch=wire]");
  await settled(page);
  assert.equal(await geometries(), before);
}
