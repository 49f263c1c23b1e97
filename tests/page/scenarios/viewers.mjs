// Rows of `viewers.md` that no other scenario tries: pictures, measures, flips, tiles, figures and mirrored seams.
import assert from "node:assert/strict";
import { assertDiffers, assertSame, colors, colorsOf, difference, project, settled, shown, variety } from "../look.mjs";

const file = (name, text) => ({ name, mimeType: "model/obj", buffer: Buffer.from(text) });
/** A square and another one beside it, the second one on the next page. */
const TILES = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n\
vt .2 .2\nvt .8 .2\nvt .8 .8\nvt .2 .8\nvt 1.2 .2\nvt 1.8 .2\nvt 1.8 .8\nvt 1.2 .8\nf 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8\n";
/** Three triangles side by side, one of them turned over in the plane. */
const FLIPPED = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt .1 .1\nvt .5 .1\nvt .5 .5\nvt .45 .2\nvt .9 .1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 2/2 5/5 3/3\n";

export async function run(page, url, picture) {
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict");
  await figures(page);
  await measures(page);
  await pictured(page, picture);
  const mirrored = await alike(page);
  const choose = async (given) => {
    await page.setInputFiles("#files", given);
    await shown(page, given.name);
    await page.click("button[data-shade=charts]");
  };
  await choose(file("flipped.obj", FLIPPED));
  await turnedOver(page);
  await choose(file("tiles.obj", TILES));
  await tiled(page);
  return mirrored;
}

/** Counts, the covered share and the texel density of a selected face are said in numbers. */
async function figures(page) {
  const facts = await page.textContent("#inspector");
  for (const fact of [/Charts\s*\d+/, /Covered\s*\d+\.\d %/, /Texels per unit\s*[\d,.]+/]) assert.match(facts, fact);
  assert.match(await page.textContent("#faults"), /No overlaps or flips/);
  await page.mouse.move(...(await project(page, "plane", 5)));
  await page.waitForFunction(() => /[\d.]+ px\/unit/.test(document.getElementById("pointed").textContent));
}

/** Stretch of angles and of areas are other pictures, and density says its least, mean and most. */
async function measures(page) {
  await page.click("button[data-shade=heat]");
  await page.click("text=Fit scale");
  const seen = {};
  for (const measure of ["sym-dirichlet", "angle", "area", "density"]) {
    await page.selectOption("#measure", measure);
    seen[measure] = await colorsOf(page, "#plane");
    assert.match(await page.textContent("#legend"), /min .+ · mean .+ · max .+/, measure);
  }
  const differ = (one, other) => seen[one].filter((color, k) => 16 < difference(color, seen[other][k])).length;
  for (const [one, other] of [["sym-dirichlet", "angle"], ["angle", "area"], ["area", "density"]]) assert.ok(10 < differ(one, other), `${one} and ${other}: ${differ(one, other)} places differ`);
  await page.selectOption("#measure", "sym-dirichlet");
  await page.click("text=Fit scale");
}

/** A picture of one's own lies on the surface and below the UVs. */
async function pictured(page, picture) {
  await page.click("button[data-shade=plain]");
  const before = [variety(await colorsOf(page, "#solid")), variety(await colorsOf(page, "#plane"))];
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("button[data-shade=image]")]);
  await chooser.setFiles(picture);
  await page.waitForSelector("button[data-shade=image][aria-pressed=true]");
  const after = [variety(await colorsOf(page, "#solid")), variety(await colorsOf(page, "#plane"))];
  for (const k of [0, 1]) assert.ok(before[k] + 10 < after[k], `${before} colors before, ${after} with the picture`);
  await page.click("button[data-shade=charts]");
}

/** Share of the seams that have their mirror image among them. */
function mirroredShare(page) {
  return page.evaluate(() => {
    const { analysis: { borders: { ends } }, model: { sphere } } = window.unwrapd.viewer;
    const middles = Array.from({ length: ends.length / 6 }, (_, k) => [0, 1, 2].map((i) => (ends[6 * k + i] + ends[6 * k + 3 + i]) / 2));
    const isNear = (one, other) => Math.hypot(...one.map((x, i) => x - other[i])) < 0.002 * sphere.radius;
    return middles.filter(([x, y, z]) => middles.some((other) => isNear(other, [-x, y, z]))).length / middles.length;
  });
}

/** Mirrored halves are cut alike, unless that is turned off. */
async function alike(page) {
  const auto = await mirroredShare(page);
  await page.click("#more summary");
  await page.fill("#find-option", "mirror");
  await page.selectOption("#option-symmetry", "off");
  const before = await page.evaluate(() => window.unwrapd.store.job.id);
  await page.click("#submit");
  await page.waitForFunction((before) => window.unwrapd.store.job?.id !== before, before);
  await page.waitForSelector(".verdict");
  await shown(page);
  const off = await mirroredShare(page);
  assert.ok(0.9 < auto && off < auto, `mirrored seams: ${auto} by default, ${off} without symmetry`);
  await page.click("#reset");
  await page.click("#more summary");
  return { auto, off };
}

/** A flipped face is red and counted. */
async function turnedOver(page) {
  assert.match(await page.textContent("#faults"), /1 flipped face/);
  const at = [await project(page, "plane", 1)];
  const [red] = await colors(page, at);
  assert.ok(red[1] + 60 < red[0], `a flipped face is red: ${red}`);
  await page.click("button[data-switch=problems]");
  assertDiffers(red, (await colors(page, at))[0], "a flipped face without its mark");
  await page.click("button[data-switch=problems]");
}

/** UVs on two pages lie on the paper of both. */
async function tiled(page) {
  await settled(page);
  const places = await page.evaluate(() => {
    const { model, stage } = window.unwrapd.viewer;
    return [0.1, 1.1, 2.02].map((u) => stage.project("plane", model.sphere.center.clone().set(u * model.aspect, 0.1, 0)));
  });
  const [first, second, none] = await colors(page, places);
  assertSame(first, second, "the paper of both pages");
  assertDiffers(second, none, "what is beyond them");
}
