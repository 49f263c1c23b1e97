// Work that takes a while: uploads, finishing early, a lost connection, and deleting.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

// A service that is gone tells in the console that it was asked for.
export const hasErrors = true;

const rows = (page) => page.locator("#job-list .row-link");
const count = (page, n) => page.waitForFunction((n) => document.querySelectorAll("#job-list .row-link").length === n, n);

export async function run(page, url, textured, before) {
  await page.goto(url);
  await shown(page, "spot.ply");
  await uploaded(page);
  await finished(page, url, before);
  await reconnected(page);
  await remedied(page, textured);
  await restored(page);
}

/** An upload says how far it is, and one that is cancelled makes no job. */
async function uploaded(page) {
  const comments = Buffer.from(`v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n${"# as long as a scan\n".repeat(60_000)}`);
  await page.setInputFiles("#files", { name: "long.obj", mimeType: "model/obj", buffer: comments });
  await shown(page, "long.obj");
  const jobs = await rows(page).count();
  const network = await page.context().newCDPSession(page);
  const speed = (bytes) => network.send("Network.emulateNetworkConditions", { offline: false, latency: 0, downloadThroughput: -1, uploadThroughput: bytes });
  await network.send("Network.enable");
  // It takes a minute, in which also a page on a busy machine looks.
  await speed(20_000);
  await page.click("#submit");
  await page.waitForFunction(() => ((sent) => 0 < sent && sent < 1)(document.querySelector("#sent").value));
  assert.ok(await page.isVisible("#sent"));
  assert.match(await page.textContent("#sent-text"), /^[\d.]+ [kM]B of 1\.2 MB sent$/);
  assert.ok(await page.isDisabled("#submit"));
  await page.click("#cancel-sending");
  await page.waitForFunction(() => document.querySelector("#sending").hidden && !document.querySelector("#submit").disabled);
  assert.ok(await page.isHidden("#problem"), "who cancels is not told that something failed");
  await speed(-1);
  assert.equal(await page.evaluate(() => fetch("v1/jobs").then((answer) => answer.json()).then(({ jobs }) => jobs.length)), jobs);
}

/** The wish to finish early is answered at once, and holds until the end. */
async function finished(page, url, before) {
  await page.click("#submit");
  await count(page, 2);
  const finish = page.locator(".progress-panel .actions button").first();
  await finish.click();
  assert.equal(await finish.textContent(), "Finishing …");
  assert.ok(await finish.isDisabled());
  assert.match(await page.textContent(".progress-panel .hint"), /current map becomes the result/);
  await page.request.delete(new URL(before, url).href);
  await page.waitForSelector(".verdict");
}

/** A lost connection is told, and ends by itself. */
async function reconnected(page) {
  await page.route(/\/v1\/jobs/, (route) => route.abort());
  await page.click("#filters summary");
  await page.selectOption("#filter-kind", "unwrap");
  await page.waitForSelector("#connection:not([hidden])");
  await page.unroute(/\/v1\/jobs/);
  await page.waitForSelector("#connection", { state: "hidden" });
  await page.selectOption("#filter-kind", "");
  await page.click("#filters summary");
  // A page that is opened meanwhile says so once, and shows what it names as soon as the service answers.
  await page.route(/\/v1\//, (route) => route.abort());
  await page.reload();
  await page.waitForSelector("#connection:not([hidden])");
  assert.ok(await page.isHidden("#problem"));
  assert.ok(!(await page.isVisible("#job-list .none")), "nobody knows whether there are jobs");
  await page.unroute(/\/v1\//);
  await page.waitForSelector("#connection", { state: "hidden" });
  await page.waitForSelector(".verdict");
  await shown(page);
}

/** A warning that has a remedy has a button for it, which makes the job that the warning speaks of. */
async function remedied(page, textured) {
  await page.setInputFiles("#files", textured);
  await shown(page, textured.split("/").pop());
  await page.click("#submit");
  await page.click("text=Move the textures to the new UVs");
  await page.waitForFunction(() => window.unwrapd.store.job?.options.rebake === true);
  await page.waitForSelector(".verdict");
  assert.ok(!(await page.isVisible("text=Move the textures to the new UVs")));
}

/** A deleted job is there again if it is wanted. */
async function restored(page) {
  const n = await rows(page).count();
  const id = await page.evaluate(() => window.unwrapd.store.place.job);
  // However slow the page is, the ten seconds for an undo are not over before the click.
  await page.evaluate(() => {
    const begin = window.setTimeout;
    window.setTimeout = (does, ms, ...more) => begin(does, ms === 10_000 ? 600_000 : ms, ...more);
  });
  await page.click("#inspector >> text=Delete");
  await count(page, n - 1);
  await page.click("#removed >> text=Undo");
  await count(page, n);
  await page.waitForSelector(".verdict");
  assert.equal(await page.evaluate(() => window.unwrapd.store.place.job), id);
  assert.equal(await page.evaluate((id) => fetch(`v1/jobs/${id}`).then(({ status }) => status), id), 200);
}
