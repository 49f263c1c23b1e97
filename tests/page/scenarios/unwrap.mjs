// A mesh is chosen, unwrapped, watched, looked at and downloaded.
import assert from "node:assert/strict";
import { colorsOf, shown, variety } from "../look.mjs";

/** Most bytes of scripts that the first view fetches, compressed. */
const MOST_SCRIPT = 240_000;

export async function run(page, url, mesh, output) {
  await page.goto(url);
  await shown(page, "spot.ply");
  const first = await page.evaluate(() => performance.now());
  // What the first view fetches of scripts, as they are sent, and nothing that it does not show.
  const fetched = await page.evaluate(() => performance.getEntriesByType("resource").map(({ name, encodedBodySize }) => [name.split("/").pop().split("?")[0], encodedBodySize]));
  const scripts = fetched.filter(([name]) => name.endsWith(".js"));
  const size = scripts.reduce((sum, [, bytes]) => sum + bytes, 0);
  assert.ok(100_000 < size && size <= MOST_SCRIPT, `${size} bytes of ${scripts}`);
  for (const name of ["openapi.json", "demand.js", "draco_decoder.wasm"]) assert.ok(!fetched.some(([other]) => other === name), name);
  await page.setInputFiles("#files", mesh);
  const name = mesh.split("/").pop();
  await shown(page, name);
  assert.equal(await page.textContent("#title"), name);
  // Asking again and again would miss what is shown for a moment.
  await page.evaluate(() => {
    const stages = (window.stages = []);
    const note = () => {
      const stage = document.querySelector(".stage")?.textContent;
      if (stage && stages.at(-1) !== stage) stages.push(stage);
    };
    new MutationObserver(note).observe(document.body, { subtree: true, childList: true, characterData: true });
  });
  await page.click("#submit");
  await page.waitForSelector(".verdict");
  const stages = await page.evaluate(() => window.stages);
  assert.equal(await page.textContent(".verdict h2"), "Certified");
  assert.ok(stages.length, "no progress was shown");
  await shown(page);
  for (const pane of ["#solid", "#plane"]) assert.ok(4 < variety(await colorsOf(page, pane)), `${pane} is empty`);
  // Numbers agree: those of the report, and those that the page computes itself.
  const charts = await page.evaluate(() => window.unwrapd.viewer.analysis.charts);
  assert.match(await page.textContent("#inspector"), new RegExp(`Charts${charts}(?!\\d)`));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(".files a.primary")]);
  await download.saveAs(output);
  return { stages, firstView: first, size };
}
