// Islands are arranged by mouse and keys: moved, locked, the others packed around them, undone; the file has them where they were put.
import assert from "node:assert/strict";
import { cornerUvs } from "../glb.mjs";
import { colors, assertDiffers, hover, pointed, project, settled, shown } from "../look.mjs";

export async function run(page, url, before, output, picture) {
  await page.goto(url);
  await shown(page);
  await download(page, before);
  const { face, chart, faces } = await island(page);
  const first = page.url().match(/job=([\w-]+)/)[1];

  // Tab leads in and out again where the pointer went into the view, and on elsewhere.
  await page.mouse.click(...(await corner(page)));
  for (const isOn of [true, false, true]) {
    await page.keyboard.press("Tab");
    assert.equal(await page.getAttribute("#arrange", "aria-pressed"), String(isOn));
  }
  assert.match(await page.textContent("#arrange-hints"), /grab, rotate, scale/);
  const at = await project(page, "plane", face);
  const solid = await project(page, "solid", face);
  await hover(page, [640, 10]);
  const [plain] = await colors(page, [at]);
  await page.mouse.click(...at);
  await hover(page, [640, 10]);
  assert.deepEqual(await state(page), { selected: [chart], locked: [], wrong: [] });
  const [picked] = await colors(page, [at]);
  assertDiffers(picked, plain, "the selected island");

  // Off the page it is red, and Escape puts it back.
  await page.mouse.move(...at);
  await page.keyboard.press("g");
  const box = await page.locator("#plane").boundingBox();
  await page.mouse.move(box.x + 4, box.y + 4, { steps: 8 });
  assert.deepEqual((await state(page)).wrong, [chart]);
  await page.keyboard.press("Escape");
  assert.deepEqual(await state(page), { selected: [chart], locked: [], wrong: [] });

  // Moved, turned and scaled; each can be undone.
  const target = await middle(page);
  await page.mouse.move(...at);
  await page.keyboard.press("g");
  await page.mouse.move(...target, { steps: 12 });
  await page.mouse.click(...target);
  assert.deepEqual((await state(page)).locked, [chart]);
  const way = await inPlane(page, [at, target]);
  await typed(page, "r", "90");
  await typed(page, "s", "0.75");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  assert.deepEqual((await state(page)).locked, []);
  for (let k = 0; k < 3; k++) await page.keyboard.press("Control+Shift+z");
  assert.deepEqual(await state(page), { selected: [chart], locked: [chart], wrong: [] });
  await settled(page);
  if (picture) await page.screenshot({ path: picture });

  await page.keyboard.press("p");
  await page.waitForFunction((job) => !location.hash.includes(job) && document.querySelector(".verdict h2")?.textContent === "Certified", first);
  await shown(page);
  await page.waitForFunction(() => !document.querySelector("#arrange-repack").disabled);
  assert.equal((await state(page)).locked[0], chart);
  await download(page, output);
  const [was, is] = [before, output].map((path) => cornerUvs(path));
  const expected = placer(was, faces, way);
  let others = 0;
  was.forEach((corners, f) => {
    if (!faces.includes(f)) others += Number(String(corners) !== String(is[f]));
    else corners.forEach((uv, k) => assertNear(is[f][k], expected(uv), `face ${f}`));
  });
  assert.ok(others > 0, "the others are packed anew");
  const inspector = await page.textContent("#inspector");
  assert.ok(inspector.includes("Copy as curl") && !inspector.includes("Copy as command"), "islands would come in a file");

  // Undo goes back to the job before, with the island where it was put.
  await page.mouse.click(...(await corner(page)));
  await page.keyboard.press("Control+z");
  await page.waitForFunction((job) => location.hash.includes(job), first);
  await shown(page);
  await page.waitForFunction(() => !document.querySelector("#arrange-repack").disabled);
  assert.deepEqual((await state(page)).locked, [chart]);

  // What no job has is asked for before the page goes.
  const asked = new Promise((resolve) => page.once("dialog", (dialog) => resolve(dialog.type()) || dialog.dismiss()));
  await page.close({ runBeforeUnload: true });
  assert.equal(await asked, "beforeunload");
  return { chart, faces: faces.length, solid, others };
}

/** Presses a key and types a number. */
async function typed(page, key, number) {
  await page.keyboard.press(key);
  for (const character of number) await page.keyboard.press(character);
  await page.keyboard.press("Enter");
}

async function state(page) {
  const { selected, locked, wrong } = await pointed(page);
  const numbers = (text) => (text ? text.split(" ").map(Number) : []);
  return { selected: numbers(selected), locked: numbers(locked), wrong: numbers(wrong) };
}

async function download(page, path) {
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(".files a.primary")]);
  await file.saveAs(path);
}

/** A small island with a face that is seen, and all its faces. */
async function island(page) {
  const charts = await page.evaluate(() => {
    const { chart, texels } = window.unwrapd.viewer.analysis;
    const of = new Map();
    chart.forEach((one, face) => of.set(one, [...(of.get(one) ?? []), face]));
    const area = (faces) => faces.reduce((sum, face) => sum + Math.abs(texels[face]), 0);
    return [...of].map(([one, faces]) => ({ chart: one, faces, area: area(faces) })).sort((a, b) => a.area - b.area);
  });
  for (const { chart, faces } of charts.slice(Math.floor(charts.length / 3))) {
    for (const face of faces.filter((_, k) => k % Math.ceil(faces.length / 8) === 0)) {
      if (Number((await hover(page, await project(page, "plane", face))).hoverFace) === face) return { face, chart, faces };
    }
  }
  throw new Error("no island is seen");
}

/** A place of the plane with nothing below it, and the middle of the page. */
async function corner(page) {
  const box = await page.locator("#plane").boundingBox();
  return [box.x + 12, box.y + box.height - 12];
}

function middle(page) {
  return page.evaluate(() => {
    const { stage, model } = window.unwrapd.viewer;
    return stage.project("plane", stage.solid.camera.position.clone().set(model.aspect / 2, 0.5, 0));
  });
}

/** Places of the page in the plane. */
function inPlane(page, places) {
  return page.evaluate((places) => places.map((place) => window.unwrapd.viewer.stage.plane.at(...place)), places);
}

/** Where UVs of the file are put: shifted as the pointer was, then turned by 90 degrees and scaled about the middle of the island. */
function placer(uvs, faces, [[u0, v0], [u1, v1]]) {
  const points = faces.flatMap((face) => uvs[face]);
  const mean = (k) => (Math.min(...points.map((uv) => uv[k])) + Math.max(...points.map((uv) => uv[k]))) / 2;
  const [u, v] = [mean(0), mean(1)];
  // v points down in the file: counter-clockwise is from v to u there.
  return ([x, y]) => [u + u1 - u0 + 0.75 * (y - v), v - v1 + v0 - 0.75 * (x - u)];
}

function assertNear(uv, expected, what) {
  const far = Math.hypot(uv[0] - expected[0], uv[1] - expected[1]);
  assert.ok(far < 2e-6, `${what}: ${uv} is not ${expected}`);
}
