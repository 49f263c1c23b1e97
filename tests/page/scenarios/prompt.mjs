// What the page knows is said at once: the title while a job is fetched, and the end of a job in the list before it is asked for.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

/** Holds the answers to a request until they are let go. */
async function held(page, pattern) {
  let letGo;
  const over = new Promise((done) => (letGo = done));
  let isAsked;
  const asked = new Promise((done) => (isAsked = done));
  await page.route(pattern, async (route) => {
    isAsked();
    await over;
    await route.continue().catch(() => {});
  });
  return { asked, letGo: async () => { letGo(); await page.unroute(pattern); } };
}

export async function run(page, url, job) {
  const fetched = await held(page, new RegExp(`v1/jobs/${job}$`));
  await page.goto(`${url}#job=${job}`);
  await fetched.asked;
  assert.equal(await page.textContent("#title"), "Loading …");
  await fetched.letGo();
  await shown(page);
  assert.equal(await page.textContent("#title"), "cat_head.obj");

  const list = await held(page, /v1\/jobs\?limit=20/);
  await page.click("label[for=purpose-few]");
  await page.click("#submit");
  await page.waitForFunction(() => window.unwrapd.store.job?.options.quality === "few");
  const id = await page.evaluate(() => window.unwrapd.store.job.id);
  await page.waitForSelector(`#job-list [data-id="${id}"] .facts.certified`);
  await list.letGo();

  await page.goto(`${url}#job=01a22773-0000-7000-8000-000000000000`);
  await page.waitForFunction(() => document.querySelector("#title").textContent === "Not found");
}
