// What is pointed at in one view is seen in the other, as a face, as a chart and as a seam.
import assert from "node:assert/strict";
import { assertDiffers, assertSame, colors, hover, pointed, project, shown, visibleFace } from "../look.mjs";

const AWAY = [640, 10];

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  await page.click("button[data-aim=face]");
  const { face, solid, plane } = await visibleFace(page);
  const [other] = await otherFaces(page, face);
  const elsewhere = await project(page, "plane", other);
  await hover(page, AWAY);
  const [solidBefore, planeBefore, otherBefore] = await colors(page, [solid, plane, elsewhere]);

  for (const [from, at, before] of [[solid, plane, planeBefore], [plane, solid, solidBefore]]) {
    assert.equal(Number((await hover(page, from)).hoverFace), face);
    const [here, beside] = await colors(page, [at, elsewhere]);
    assertDiffers(here, before, "the face in the other view");
    assertSame(beside, otherBefore, "another face");
    assert.match(await page.textContent("#pointed"), /chart \d+ of \d+/);
  }

  await page.click("button[data-aim=chart]");
  assert.ok((await hover(page, solid)).hoverChart);
  const [inChart, sameChart] = await colors(page, [plane, elsewhere]);
  assertDiffers(inChart, planeBefore, "the chart in the other view");
  assertDiffers(sameChart, otherBefore, "another face of the chart");

  await page.mouse.click(...solid);
  await hover(page, AWAY);
  assert.equal((await pointed(page)).hoverFace, undefined);
  // An outline marks what is selected; its fill is still there to be judged.
  const border = await borderOf(page, face);
  const [selected, outline] = await colors(page, [plane, border]);
  assertSame(selected, planeBefore, "the fill of the selected chart");
  assert.ok(outline[2] + 100 < outline[0], `the outline is orange: ${outline}`);
  await page.click("button[data-switch=seams]");
  const [, alone] = await colors(page, [plane, border]);
  assertSame(alone, outline, "the outline without seams");
  await page.click("button[data-switch=seams]");
  assert.match(page.url(), /chart=\d+/);
  await seams(page);
}

/** Where the middle of the longest border of a face's chart is in the plane. */
function borderOf(page, face) {
  return page.evaluate((face) => {
    const { analysis: { borders, chart }, stage, model } = window.unwrapd.viewer;
    const length = (k) => Math.hypot(borders.uvs[4 * k] - borders.uvs[4 * k + 2], borders.uvs[4 * k + 1] - borders.uvs[4 * k + 3]);
    const own = [...borders.face.keys()].filter((k) => chart[borders.face[k]] === chart[face]);
    const [u0, v0, u1, v1] = borders.uvs.slice(4 * own.sort((one, other) => length(other) - length(one))[0]);
    return stage.project("plane", stage.solid.camera.position.clone().set(((u0 + u1) / 2) * model.aspect, (v0 + v1) / 2, 0));
  }, face);
}

/** Faces of the same chart. */
function otherFaces(page, face) {
  return page.evaluate((face) => {
    const { chart } = window.unwrapd.viewer.analysis;
    const far = [...chart.keys()].filter((other) => other !== face && chart[other] === chart[face]);
    return [far.at(-1)];
  }, face);
}

async function seams(page) {
  await page.mouse.click(...(await corner(page)));
  await page.click("button[data-aim=seam]");
  // Borders of charts may be less than a pixel apart: one that is alone is looked for.
  for (const { middle, seam } of await middles(page)) {
    await hover(page, AWAY);
    const [before] = await colors(page, [middle]);
    if (Number((await hover(page, middle)).hoverSeam) !== seam) continue;
    const [after] = await colors(page, [middle]);
    assertDiffers(after, before, "the seam");
    return;
  }
  assert.fail("no seam is pointed at");
}

/** Where the middles of the longest edges of seams are in the plane. */
function middles(page) {
  return page.evaluate(() => {
    const { analysis: { borders }, stage, model } = window.unwrapd.viewer;
    const length = (k) => Math.hypot(borders.uvs[4 * k] - borders.uvs[4 * k + 2], borders.uvs[4 * k + 1] - borders.uvs[4 * k + 3]);
    const seams = [...borders.face.keys()].filter((k) => borders.marks[k] & 8).sort((one, other) => length(other) - length(one));
    return seams.slice(0, 12).map((k) => {
      const [u0, v0, u1, v1] = borders.uvs.slice(4 * k, 4 * k + 4);
      const point = stage.solid.camera.position.clone().set(((u0 + u1) / 2) * model.aspect, (v0 + v1) / 2, 0);
      return { middle: stage.project("plane", point), seam: borders.seam[k] };
    });
  });
}

/** A place of the plane with nothing below it. */
async function corner(page) {
  const box = await page.locator("#plane").boundingBox();
  return [box.x + 12, box.y + box.height - 12];
}
