// Fills, seams and heat maps change the pixels that they must.
import assert from "node:assert/strict";
import { assertDiffers, assertSame, colors, colorsOf, difference, project, settled, shown } from "../look.mjs";

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  const facts = await page.evaluate(() => {
    const { analysis } = window.unwrapd.viewer;
    const { worst } = analysis.atlases[0].spreads[0];
    const values = [...analysis.chart.keys()].sort((one, other) => analysis.values[4 * one] - analysis.values[4 * other]);
    // Of the most stretched faces the one that is seen best.
    const stretched = values.slice(-10).reduce((one, other) => (Math.abs(analysis.texels[one]) < Math.abs(analysis.texels[other]) ? other : one));
    return { best: values[0], stretched, worst: worst[0] };
  });
  await heat(page, facts);
  await checker(page);
  await coarser(page);
  await seams(page);
  await isolated(page);
  await located(page, facts);
  await metal(page);
}

async function heat(page, { best, stretched }) {
  const seen = async () => {
    await settled(page);
    return colors(page, [await project(page, "plane", best), await project(page, "plane", stretched)]);
  };
  await page.click("button[data-switch=seams]");
  await page.click("button[data-shade=plain]");
  const plain = await seen();
  assertSame(plain[0], plain[1], "plain faces");
  await page.click("button[data-shade=heat]");
  const [low, high] = await seen();
  const brightness = (color) => color.reduce((sum, x) => sum + x, 0);
  assert.ok(brightness(high) + 120 < brightness(low), `a stretched face is dark: ${low}, ${high}`);
  assert.match(await page.textContent("#legend"), /min .* % · mean .* % · max .* %/);
  // All results have the same colors, unless they are asked to be spread over one.
  assert.equal(await page.textContent(".scale .ends >> nth=1"), "100 %");
  await page.click("text=Fit scale");
  assert.notEqual(await page.textContent(".scale .ends >> nth=1"), "100 %");
  const [, fitted] = await seen();
  assert.ok(brightness(fitted) < brightness(high), `a stretched face is darker on a scale of its own: ${fitted}, ${high}`);
  assert.match(page.url(), /scale=fitted/);
  await page.click("text=Fit scale");
  await page.selectOption("#measure", "density");
  const [, density] = await seen();
  assertDiffers(density, high, "texel density");
  assert.match(await page.textContent("#legend"), /px\/unit/);
  await page.click("button[data-switch=seams]");
}

/** Cells have one color each, light or dark by turns: nothing is blended between them. */
async function checker(page) {
  await page.click("button[data-shade=checker]");
  await page.click("button[data-switch=seams]");
  const cells = await page.evaluate(() => {
    const { analysis, stage, model } = window.unwrapd.viewer;
    const { uvs } = analysis.drawn;
    const point = stage.solid.camera.position.clone();
    const found = [];
    for (let k = 0; k < analysis.drawn.count; k++) {
      const u = (uvs[6 * k] + uvs[6 * k + 2] + uvs[6 * k + 4]) / 3;
      const v = (uvs[6 * k + 1] + uvs[6 * k + 3] + uvs[6 * k + 5]) / 3;
      const inside = [u * 32 % 1, v * 32 % 1].every((t) => 0.25 < t && t < 0.75);
      if (inside) found.push({ odd: (Math.floor(u * 32) + Math.floor(v * 32)) % 2, place: stage.project("plane", point.set(u * model.aspect, v, 0)) });
    }
    return found.slice(0, 80);
  });
  assert.ok(8 < cells.length, "there are cells to look at");
  const seen = await colors(page, cells.map(({ place }) => place));
  for (const [k, { odd }] of cells.entries()) {
    assert.equal(seen[k][1] < 170, odd === 1, `cell ${k} is ${seen[k]}`);
  }
  await page.click("button[data-switch=seams]");
}

async function seams(page) {
  await page.click("button[data-shade=plain]");
  const place = await page.evaluate(() => {
    const { analysis: { borders }, stage, model } = window.unwrapd.viewer;
    const length = (k) => Math.hypot(borders.uvs[4 * k] - borders.uvs[4 * k + 2], borders.uvs[4 * k + 1] - borders.uvs[4 * k + 3]);
    const longest = [...borders.face.keys()].sort((one, other) => length(other) - length(one))[0];
    const [u0, v0, u1, v1] = borders.uvs.slice(4 * longest, 4 * longest + 4);
    return stage.project("plane", stage.solid.camera.position.clone().set(((u0 + u1) / 2) * model.aspect, (v0 + v1) / 2, 0));
  });
  const [on] = await colors(page, [place]);
  assert.ok(on[0] + 60 < on[2], `a seam is blue: ${on}`);
  await page.click("button[data-switch=seams]");
  const [off] = await colors(page, [place]);
  assertDiffers(on, off, "a seam");
  await settled(page);
}

/** Metal reflects its surroundings: it is no black hole. */
async function metal(page) {
  const corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]].flat();
  const bytes = Buffer.concat([Buffer.from(Float32Array.from(corners).buffer), Buffer.from(Uint16Array.of(0, 1, 2, 0, 2, 3).buffer)]);
  const plate = {
    asset: { version: "2.0" }, scene: 0, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0 }], meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1, material: 0 }] }],
    materials: [{ pbrMetallicRoughness: { metallicFactor: 1, roughnessFactor: 0.3 } }], buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString("base64")}` }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0] }, { bufferView: 1, componentType: 5123, count: 6, type: "SCALAR" }],
  };
  await page.setInputFiles("#files", { name: "plate.gltf", mimeType: "model/gltf+json", buffer: Buffer.from(JSON.stringify(plate)) });
  await shown(page, "plate.gltf");
  await page.click("button[data-shade=material]");
  const [seen] = await colors(page, [await project(page, "solid", 0)]);
  assert.ok(seen.every((x) => 70 < x), `metal is lit: ${seen}`);
}

/** Larger cells are another checkerboard, and the address says so. */
async function coarser(page) {
  await page.click("button[data-shade=checker]");
  const fine = await colorsOf(page, "#plane");
  await page.selectOption("#cells", "8");
  const coarse = await colorsOf(page, "#plane");
  assert.ok(20 < fine.filter((color, k) => 16 < difference(color, coarse[k])).length, "the cells changed");
  assert.match(page.url(), /cells=8/);
  await page.selectOption("#cells", "32");
}

/** The selected chart alone is seen. */
async function isolated(page) {
  await page.click("button[data-shade=charts]");
  const [one, other] = await page.evaluate(() => {
    const { chart } = window.unwrapd.viewer.analysis;
    return [chart.indexOf(0), chart.findIndex((number) => number !== 0)];
  });
  assert.ok(0 <= other, "there are several charts");
  const places = [await project(page, "plane", one), await project(page, "plane", other)];
  await page.mouse.click(...places[0]);
  const all = await colors(page, places);
  await page.click("button[data-switch=only]");
  const alone = await colors(page, places);
  assertDiffers(all[1], alone[1], "another chart");
  await page.click("button[data-switch=only]");
  assertSame((await colors(page, places))[1], all[1], "the chart is back");
}

/** The line below the views has the coordinates of the pointer. */
async function located(page, { best }) {
  const [u, v] = await page.evaluate((face) => {
    const { place, aspect } = ((model) => ({ place: model.place(face), aspect: model.aspect }))(window.unwrapd.viewer.model);
    return [place.u / aspect, place.v];
  }, best);
  await page.mouse.move(...(await project(page, "plane", best)));
  await settled(page);
  await page.waitForFunction(() => document.getElementById("pointed").textContent.startsWith("u "));
  const [, right, up] = /^u (\S+), v (\S+) · texel \d+, \d+/.exec(await page.textContent("#pointed"));
  assert.ok(Math.hypot(right - u, up - v) < 0.01, `${right}, ${up} is not ${u}, ${v}`);
}
