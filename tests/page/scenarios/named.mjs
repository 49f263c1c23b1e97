// Jobs have names and tags, which the service keeps, and are found by them.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

const rows = (page) => page.locator("#job-list .row-link .name").allTextContents();
const listed = (page, expected) => page.waitForFunction((expected) => JSON.stringify([...document.querySelectorAll("#job-list .name, #job-list .none")].map(({ textContent }) => textContent)) === JSON.stringify(expected), expected);

export async function run(page, url, job, other) {
  await page.goto(`${url}#job=${job}`);
  await shown(page);
  const metadata = (id = job) => page.evaluate((id) => fetch(`v1/jobs/${id}`).then((answer) => answer.json()).then(({ metadata }) => metadata), id);
  assert.deepEqual(await metadata(), { project: "atlas" });

  // A name and tags, by the keyboard; what else is noted stays.
  await page.focus("#job-name");
  await page.keyboard.type("Cat, final");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector("#title").textContent === "Cat, final");
  await page.fill("#job-tags", "hero, low poly");
  await page.press("#job-tags", "Enter");
  await listed(page, ["Fox.glb", "Cat, finalherolow poly"]);
  assert.deepEqual(await metadata(), { project: "atlas", name: "Cat, final", hero: true, "low poly": true });
  assert.match(await page.textContent("#inspector"), /projectatlas/);

  // They are there after a reload, and jobs are found by words of them.
  await page.reload();
  await shown(page);
  assert.equal(await page.textContent("#title"), "Cat, final");
  assert.equal(await page.inputValue("#job-tags"), "hero, low poly");
  for (const [words, found] of [["hero", 1], ["FINAL cat", 1], ["cat_head", 1], ["fox", 1], ["glb hero", 0]]) {
    await page.fill("#search-jobs", words);
    await page.waitForFunction((found) => document.querySelectorAll("#job-list .row-link").length === found, found);
  }
  await listed(page, ["No job meets the filter."]);
  await page.fill("#search-jobs", "");
  await page.waitForFunction(() => document.querySelectorAll("#job-list .row-link").length === 2);
  // A tag is a member of the metadata, so the filter of the service finds it too.
  await page.click("#filters summary");
  await page.fill("#filter-metadata", "hero=true");
  await page.press("#filter-metadata", "Enter");
  await listed(page, ["Cat, finalherolow poly"]);
  await page.fill("#filter-metadata", "");
  await page.press("#filter-metadata", "Enter");

  // Without a name, a job has that of its file again.
  await page.fill("#job-name", "");
  await page.press("#job-name", "Enter");
  await page.waitForFunction(() => document.querySelector("#title").textContent === "cat_head.obj");
  assert.deepEqual(await rows(page), ["Fox.glb", "cat_head.objherolow poly"]);
  assert.deepEqual(await metadata(other), {});
}
