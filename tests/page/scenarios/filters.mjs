// What an operator looks for: jobs by state, kind, time and metadata, what was noted of one, and whether it meets its gates.
import assert from "node:assert/strict";

export async function run(page, url, noted) {
  await page.goto(`${url}#job=${noted}`);
  await page.waitForSelector("#inspector .verdict >> text=Not accepted");
  const said = await page.textContent("#inspector");
  assert.match(said, /does not meet every gate: max_charts=1/);
  assert.match(said, /batch7/);
  assert.match(said, /assetchair/);
  await page.waitForSelector(".facts.refused");
  const names = async (expected) => {
    await page.waitForFunction((expected) => {
      const shown = [...document.querySelectorAll("#job-list .name, #job-list .none")].map(({ textContent }) => textContent);
      return JSON.stringify(shown.toSorted()) === JSON.stringify(expected.toSorted());
    }, expected);
  };
  await names(["Box.glb", "bad.obj", "Fox.glb"]);
  await page.click("#filters summary");
  await page.fill("#filter-metadata", "batch=7, asset=chair");
  await page.press("#filter-metadata", "Enter");
  await names(["Box.glb"]);
  assert.equal(await page.textContent("#filtered"), "on");
  await page.fill("#filter-metadata", "");
  await page.selectOption("#filter-state", "failed");
  await names(["bad.obj"]);
  await page.selectOption("#filter-state", "");
  await page.selectOption("#filter-kind", "measure");
  await names(["Fox.glb"]);
  await page.selectOption("#filter-kind", "warp");
  await names(["No job meets the filter."]);
  await page.selectOption("#filter-kind", "");
  await page.selectOption("#filter-since", "1");
  await names(["Box.glb", "bad.obj", "Fox.glb"]);

  // An answer to an earlier question that comes late is not shown.
  let late;
  const isHeld = new Promise((held) => void page.route(/state=succeeded/, (route) => { late = route; held(); }, { times: 1 }));
  await page.selectOption("#filter-state", "succeeded");
  await isHeld;
  await page.selectOption("#filter-state", "failed");
  await names(["bad.obj"]);
  const answered = page.waitForResponse(/state=succeeded/);
  await late.continue();
  await (await answered).finished();
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  await names(["bad.obj"]);
  assert.equal(await page.textContent("#job-list .name"), "bad.obj");
}
