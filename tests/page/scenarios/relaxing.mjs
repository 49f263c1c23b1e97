// Charts relax in the UV view while the job runs, and then the result takes their place.
import assert from "node:assert/strict";
import { colorsOf, shown, variety } from "../look.mjs";
import { mapsOf, turnedOver } from "../maps.mjs";

/** `before` is a job that keeps the only worker busy until the page watches its own. */
export async function run(page, url, mesh, before) {
  const answers = [];
  page.on("response", (answer) => {
    if (answer.url().includes("/maps?") && answer.status() === 200) answers.push(answer.body().then(mapsOf, () => []));
  });
  const { promise: seen, resolve: hasSeen } = withResolvers();
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
  // However fast the job is, the page learns of its end after the charts were looked at.
  await page.route(/\/v1\/jobs(\?|$)|\/(events|report|result)(\?|$)/, async (route) => {
    if (route.request().method() === "GET") await seen;
    await route.continue();
  });
  const asked = page.waitForRequest((request) => request.url().includes("/maps?"));
  await page.click("#submit");
  await asked;
  await page.request.delete(new URL(before, url).href);
  await page.waitForSelector("#relaxing:not(:empty)");
  const described = await page.textContent("#relaxing");
  // More may be said: of plans, or of faces that are not drawn.
  assert.match(described, /^\d+ charts?\b/);
  assert.match(described, /\b0 flips\b/);
  assert.ok(3 < variety(await colorsOf(page, "#plane")), "charts are drawn");
  hasSeen();

  await page.waitForSelector(".verdict");
  // The result takes their place.
  await page.waitForSelector("#relaxing:empty", { state: "attached" });
  await shown(page);
  assert.ok(4 < variety(await colorsOf(page, "#plane")));

  // How far charts move by then is a matter of speed, and tested over HTTP.
  const frames = await Promise.all(answers);
  assert.ok(frames.some((maps) => maps.length), "a frame was sent");
  for (const map of frames.flat()) assert.equal(turnedOver(map), 0, `chart ${map.first}, iteration ${map.iteration}`);
  return { frames: frames.length, charts: frames.map((maps) => maps.length), described };
}

/** What newer versions of Node have as `Promise.withResolvers`. */
function withResolvers() {
  let resolve;
  const promise = new Promise((fulfil) => { resolve = fulfil; });
  return { promise, resolve };
}
