// axe finds nothing, in any view, dark or light, wide or narrow; the viewer of the API is its makers'.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { shown } from "../look.mjs";

const source = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

async function check(page, where) {
  // `#api` is all that Swagger UI makes: what axe finds there is for its makers to mend, and is not shown by this test.
  await page.evaluate(source);
  const { violations } = await page.evaluate(() => window.axe.run({ exclude: ["#api"] }));
  const said = violations.flatMap(({ id, nodes }) => nodes.map((node) => `${id}: ${node.html.slice(0, 120)} ${node.failureSummary}`));
  assert.deepEqual(said, [], where);
}

export async function run(page, url, job) {
  let checked = 0;
  for (const colorScheme of ["light", "dark"]) {
    for (const width of [1280, 700, 380]) {
      await page.emulateMedia({ colorScheme });
      await page.setViewportSize({ width, height: 800 });
      await page.goto(`${url}#job=${job}&shade=heat`);
      await page.reload();
      await shown(page);
      await check(page, `${colorScheme} view at ${width}`);
      const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(overflow <= 0, `nothing is wider than ${width}: ${overflow}`);
      await page.click("#arrange");
      await check(page, `${colorScheme} arranging at ${width}`);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
      assert.ok(wide <= 0, `nothing is wider than ${width} while islands are arranged: ${wide}`);
      await page.click("#arrange");
      await page.click("#tab-report");
      await page.waitForSelector(".certificate");
      await check(page, `${colorScheme} report at ${width}`);
      await page.click("#tab-batch");
      for (const layout of ["Table", "Contact sheet"]) {
        await page.click(`#batch button:has-text("${layout}")`);
        await page.waitForSelector(layout === "Table" ? "#batch tbody a" : ".contact-sheet img");
        await check(page, `${colorScheme} batch at ${width}: ${layout}`);
        const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
        assert.ok(overflow <= 0, `nothing is wider than ${width} in a batch: ${overflow}`);
      }
      await page.click("#tab-pull");
      await page.click("#pull-start");
      await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
      await check(page, `${colorScheme} pull at ${width}`);
      await page.click("#pull-tools button:has-text('End')");
      await check(page, `${colorScheme} pull at its end at ${width}`);
      checked += 7;
    }
    await page.setViewportSize({ width: 1280, height: 800 });
    await page.click("#tab-view");
    await page.click("#more summary");
    await page.waitForSelector("#options .option");
    await check(page, `${colorScheme} options`);
    await page.keyboard.press("Escape");
    await page.click("#keys-button");
    await page.waitForSelector("#keys[open]");
    await check(page, `${colorScheme} keys`);
    await page.goto(`${url}docs`);
    await page.waitForSelector(".opblock");
    await check(page, `${colorScheme} API`);
    checked += 3;
  }
  return { checked };
}
