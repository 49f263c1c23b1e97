// Seams that the surface hides are neither seen nor pointed at.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  const { far, near } = await page.evaluate(() => {
    const { viewer } = window.unwrapd;
    const { stage, model, analysis } = viewer;
    const { camera } = stage.solid;
    const box = document.querySelector("#solid").getBoundingClientRect();
    const distance = (x, y, z) => Math.hypot(camera.position.x - x, camera.position.y - y, camera.position.z - z);
    const counts = { far: 0, near: 0 };
    for (let j = 2; j < 30; j++) {
      for (let i = 2; i < 30; i++) {
        const hit = stage.pick(model, "solid", (i / 32) * box.width, (j / 32) * box.height, true);
        if (!hit || hit.border < 0) continue;
        const ends = analysis.borders.ends.subarray(6 * hit.border, 6 * hit.border + 6);
        const to = distance(...[0, 1, 2].map((k) => (ends[k] + ends[k + 3]) / 2));
        // What is seen of the surface there is nearer than a seam behind it.
        counts[distance(...model.place(hit.face).middle.toArray()) + 0.15 * model.sphere.radius < to ? "far" : "near"] += 1;
      }
    }
    return counts;
  });
  assert.ok(3 < near, `${near} seams are seen`);
  assert.equal(far, 0, "seams on the far side");
  return { far, near };
}
