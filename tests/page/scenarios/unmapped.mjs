// Faces without UVs hide nothing: overlaps of the others are counted, and they are no charts.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

/** Six quadrilaterals on one square of the texture, and a triangle without UVs. */
const STACKED = `${[0, 1, 2, 3, 4, 5].map((k) => `v ${2 * k} 0 0\nv ${2 * k + 1} 0 0\nv ${2 * k + 1} 1 0\nv ${2 * k} 1 0\n`).join("")}v 0 5 0\nv 1 5 0\nv 0 6 0
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n${[0, 1, 2, 3, 4, 5].map((k) => `f ${4 * k + 1}/1 ${4 * k + 2}/2 ${4 * k + 3}/3 ${4 * k + 4}/4\n`).join("")}f 25 26 27\n`;

export async function run(page, url) {
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", { name: "stacked.obj", mimeType: "model/obj", buffer: Buffer.from(STACKED) });
  await shown(page, "stacked.obj");
  const faults = await page.textContent("#faults");
  assert.match(faults, /\d+ overlaps/);
  assert.match(faults, /1 face without UVs/);
  assert.match(await page.textContent("#inspector"), /UV charts6/);
  return faults;
}
