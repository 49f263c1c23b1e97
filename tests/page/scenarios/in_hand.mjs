// Files that have no surface are taken in hand wherever they are chosen: a picture and a body.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url, picture, body) {
  await page.goto(url);
  await shown(page, "spot.ply");
  for (const [path, way] of [[picture, "Picture"], [body, "Mesh"]]) {
    await page.click("#tab-view");
    await page.setInputFiles("#files", path);
    await page.waitForSelector("#tab-pull[aria-selected=true]");
    await page.waitForFunction((name) => document.querySelector("#title").textContent === name, path.split("/").pop());
    assert.equal(await page.locator("#pull-way option:checked").textContent(), way);
    await page.click("#pull-start");
    await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
    await page.click("#pull-tools >> text=End");
  }
  assert.ok(await page.isHidden("#problem"));
}
