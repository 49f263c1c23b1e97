// Charts relax in the UV view while the job runs, and then the result takes their place.
import assert from "node:assert/strict";
import { colorsOf, shown, variety } from "../look.mjs";
import { mapsOf, turnedOver } from "../maps.mjs";

/** `before` is a job that keeps the only worker busy until the page watches its own. */
export async function run(page, url, mesh, before) {
  const answers = [];
  page.on("response", (answer) => {
    if (answer.url().includes("/maps?") && answer.status() === 200) answers.push(answer.body());
  });
  // However slow the page is, the result comes after it was looked at.
  const { promise: seen, resolve: hasSeen } = withResolvers();
  await page.route(/\/(report|result)(\?|$)/, async (route) => {
    await seen;
    await route.continue();
  });
  await page.goto(url);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
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

  const frames = (await Promise.all(answers)).map(mapsOf);
  assert.ok(frames[0].some(({ iteration }) => iteration === 0), "the first frame has a start");
  // A page that is slower than the job, as beside other work, sees only the first.
  assert.ok(frames.length === 1 || frames.flat().some(({ iteration }) => 0 < iteration), "charts move");
  for (const map of frames.flat()) assert.equal(turnedOver(map), 0, `chart ${map.first}, iteration ${map.iteration}`);
  return { frames: frames.length, charts: frames.map((maps) => maps.length), described };
}

/** What newer versions of Node have as `Promise.withResolvers`. */
function withResolvers() {
  let resolve;
  const promise = new Promise((fulfil) => { resolve = fulfil; });
  return { promise, resolve };
}
