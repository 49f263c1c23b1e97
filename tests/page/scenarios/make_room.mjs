// While an island is dragged, the others make room; what is let go stays, is undone in one step, and is baked to a certified file.
import assert from "node:assert/strict";
import { cornerUvs } from "../glb.mjs";
import { pointed, settled, shown } from "../look.mjs";

/** Distance of UVs in the file from where they are seen: frames and the texture of places have 32 bits. */
const NEAR = 1e-5;

export async function run(page, url, output, picture) {
  await page.goto(url);
  await shown(page);
  const first = page.url().match(/job=([\w-]+)/)[1];
  await page.click("#arrange");
  const chart = await median(page);
  const at = await middleOf(page, chart);
  await page.mouse.click(...(await onPage(page, at)));
  assert.equal((await pointed(page)).selected, String(chart));
  await page.keyboard.press("m");
  const button = page.locator("button[data-does=room]");
  assert.equal(await button.getAttribute("aria-pressed"), "true");

  // Dragged around: no island overlaps another one, and the one that is held is where the pointer is.
  await page.mouse.move(...(await onPage(page, at)));
  await page.keyboard.press("g");
  const aspect = await page.evaluate(() => window.unwrapd.viewer.model.aspect);
  const way = [[0.5, 0.5], [0.62, 0.45], [0.45, 0.6], [0.5, 0.5]].map(([x, y]) => [x * aspect, y]);
  let made = 0;
  for (const to of way) {
    await page.mouse.move(...(await onPage(page, to)), { steps: 6 });
    await still(page);
    const { now, pairs } = await overlaps(page, chart);
    assert.deepEqual(pairs, [], `at ${to}`);
    made = Math.max(made, now.moved);
    const held = await middleOf(page, chart);
    assert.ok(Math.hypot(held[0] - to[0], held[1] - to[1]) < 0.01, `${held} is not ${to}`);
    assert.equal((await pointed(page)).wrong, "", `at ${to}`);
  }
  assert.ok(made > 0, "others make room");
  if (picture) await page.screenshot({ path: picture });
  await page.mouse.click(...(await onPage(page, way.at(-1))));
  await still(page);
  const after = await places(page);
  assert.equal((await pointed(page)).locked, String(chart));

  // Escape puts all back, and an undo as well; the islands make room again afterwards.
  await page.keyboard.press("g");
  await page.mouse.move(...(await onPage(page, [0.3 * aspect, 0.3])), { steps: 4 });
  await page.waitForFunction((was) => String([...window.unwrapd.viewer.stage.uniforms.uPlaced.value.image.data]) !== was, String(after));
  await page.keyboard.press("Escape");
  await settled(page);
  assert.deepEqual(await places(page), after);
  await page.keyboard.press("Control+z");
  assert.deepEqual((await overlaps(page, chart)).now, { moved: 0 });
  await page.keyboard.press("Control+Shift+z");
  assert.deepEqual(await places(page), after);
  await page.mouse.move(...(await onPage(page, way.at(-1))));
  await page.keyboard.press("r");
  for (const character of "30") await page.keyboard.press(character);
  await still(page);
  assert.deepEqual((await overlaps(page, chart)).pairs, []);
  await page.keyboard.press("Enter");
  await still(page);
  const shownAt = await shownUvs(page);

  // Baked: the file has all islands where they were seen.
  await page.keyboard.press("b");
  await page.waitForFunction((job) => !location.hash.includes(job) && document.querySelector(".verdict h2")?.textContent === "Certified", first);
  await shown(page);
  const [file] = await Promise.all([page.waitForEvent("download"), page.click(".files a.primary")]);
  await file.saveAs(output);
  const uvs = cornerUvs(output);
  assert.equal(uvs.length, shownAt.length);
  uvs.forEach((corners, face) => corners.forEach(([u, v], k) => {
    const [x, y] = shownAt[face][k];
    assert.ok(Math.hypot(u - x, 1 - v - y) < NEAR, `face ${face}: ${[u, v]} is not at ${[x, 1 - y]}`);
  }));
  // The session ends with the arrangement.
  await page.waitForFunction(async () => (await (await fetch("v1/sessions")).json()).sessions.length === 0);
  return { chart, made };
}

/** Waits until the islands have stopped. */
async function still(page) {
  await page.waitForFunction(() => document.getElementById("panes").dataset.room === "settled");
  await settled(page);
}

/** The chart of the median area. */
function median(page) {
  return page.evaluate(() => {
    const { chart, texels } = window.unwrapd.viewer.analysis;
    const areas = new Map();
    chart.forEach((one, face) => areas.set(one, (areas.get(one) ?? 0) + Math.abs(texels[face])));
    return [...areas].sort(([, a], [, b]) => b - a)[Math.floor(areas.size / 2)][0];
  });
}

function onPage(page, [x, y]) {
  return page.evaluate(([x, y]) => {
    const { stage } = window.unwrapd.viewer;
    return stage.project("plane", stage.solid.camera.position.clone().set(x, y, 0));
  }, [x, y]);
}

/** The places of islands on the GPU. */
function places(page) {
  return page.evaluate(() => [...window.unwrapd.viewer.stage.uniforms.uPlaced.value.image.data]);
}

/** The UVs of all corners as they are seen, v up, with their charts. */
async function seen(page) {
  return page.evaluate(() => {
    const { analysis, model, stage } = window.unwrapd.viewer;
    const numbers = stage.uniforms.uPlaced.value.image.data;
    const { aspect } = model;
    const { face: faces, uvs } = analysis.drawn;
    const drawn = new Map([...faces].map((face, k) => [face, k]));
    return [...analysis.chart].map((chart, face) => {
      const [a, b, s, t] = numbers.subarray(8 * chart);
      const corners = [0, 2, 4].map((k) => [uvs[6 * drawn.get(face) + k] * aspect, uvs[6 * drawn.get(face) + k + 1]]);
      return { chart, isMoved: a !== 1 || b !== 0 || s !== 0 || t !== 0, corners: corners.map(([x, y]) => [(a * x - b * y + s) / aspect, b * x + a * y + t]) };
    });
  });
}

async function shownUvs(page) {
  return (await seen(page)).map(({ corners }) => corners);
}

/** The middle of the rectangle around a chart, in the plane. */
async function middleOf(page, chart) {
  const aspect = await page.evaluate(() => window.unwrapd.viewer.model.aspect);
  const points = (await seen(page)).filter((face) => face.chart === chart).flatMap(({ corners }) => corners);
  const mean = (k) => (Math.min(...points.map((uv) => uv[k])) + Math.max(...points.map((uv) => uv[k]))) / 2;
  return [mean(0) * aspect, mean(1)];
}

/** Pairs of charts that overlap, and how many others than one have moved. */
async function overlaps(page, held) {
  const faces = await seen(page);
  const boxes = faces.map(({ corners }) => [0, 1].map((k) => [Math.min(...corners.map((uv) => uv[k])), Math.max(...corners.map((uv) => uv[k]))]));
  const pairs = new Set();
  faces.forEach((one, i) => faces.forEach((other, j) => {
    if (j <= i || one.chart === other.chart) return;
    if ([0, 1].some((k) => boxes[i][k][1] <= boxes[j][k][0] || boxes[j][k][1] <= boxes[i][k][0])) return;
    if (meet(one.corners, other.corners)) pairs.add(`${one.chart} ${other.chart}`);
  }));
  const moved = new Set(faces.filter(({ chart, isMoved }) => isMoved && chart !== held).map(({ chart }) => chart)).size;
  return { pairs: [...pairs], now: { moved } };
}

/** Whether the insides of two triangles meet: no side of either separates them. */
function meet(one, other) {
  return ![[one, other], [other, one]].some(([sides, points]) => sides.some((p, k) => {
    const [q, r] = [sides[(k + 1) % 3], sides[(k + 2) % 3]];
    const side = ([x, y]) => (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    return points.every((point) => side(point) * Math.sign(side(r)) <= 0);
  }));
}
