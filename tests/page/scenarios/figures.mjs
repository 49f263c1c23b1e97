// What the views cost, for the README of the tests: run it by hand as `node drive.mjs figures URL FACES…`. Frames per second of a
// software renderer mean nothing and are not counted.
import { shown } from "../look.mjs";

/** A wavy square with UVs, as OBJ. */
function sheet(faces) {
  const side = Math.round(Math.sqrt(faces / 2));
  const lines = [];
  for (let j = 0; j <= side; j++) {
    for (let i = 0; i <= side; i++) {
      const [u, v] = [i / side, j / side];
      lines.push(`v ${u} ${v} ${0.05 * Math.sin(9 * u) * Math.cos(7 * v)}`, `vt ${0.01 + 0.98 * u} ${0.01 + 0.98 * v}`);
    }
  }
  const corner = (i, j) => `${j * (side + 1) + i + 1}/${j * (side + 1) + i + 1}`;
  for (let j = 0; j < side; j++) {
    for (let i = 0; i < side; i++) {
      const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
      lines.push(`f ${a} ${b} ${c}`, `f ${a} ${c} ${d}`);
    }
  }
  return Buffer.from(lines.join("\n"));
}

export async function run(page, url, ...counts) {
  page.setDefaultTimeout(900_000);
  await page.goto(url);
  await shown(page, "spot.ply");
  const { firstView, loaded } = await page.evaluate(() => ({
    firstView: performance.getEntriesByName("first view")[0]?.startTime,
    loaded: performance.getEntriesByType("resource").map(({ name, encodedBodySize }) => [name.split("/").pop(), encodedBodySize]),
  }));
  const views = [];
  for (const count of counts) {
    const begin = Date.now();
    await page.setInputFiles("#files", { name: `${count}.obj`, mimeType: "model/obj", buffer: sheet(Number(count)) });
    await shown(page, `${count}.obj`);
    const seconds = (Date.now() - begin) / 1000;
    views.push({ faces: Number(count), seconds, ...(await page.evaluate(measured)) });
  }
  return { firstView, loaded, views };
}

/** Turns the surface for some frames. */
async function measured() {
  const { stage, model } = window.unwrapd.viewer;
  const frame = () => new Promise((drawn) => requestAnimationFrame(drawn));
  const times = [];
  for (let k = 0; k < 12; k++) {
    stage.solid.camera.position.x *= 1.01;
    stage.redraw();
    await frame();
    await frame();
    times.push(stage.figures.milliseconds);
  }
  const { calls, triangles } = stage.renderer.info.render;
  return { scriptMs: times.sort((one, other) => one - other)[6], calls, triangles, gpuBytes: model.surface.bytes };
}
