// In the dark the views, the thumbnails and the drawn layouts are dark, too: by the system's wish, and by the button.
import assert from "node:assert/strict";
import { colors, colorsOf, shown } from "../look.mjs";

const brightness = ([r, g, b]) => (r + g + b) / 3;
const mean = (some) => some.map(brightness).reduce((sum, one) => sum + one, 0) / some.length;

const THUMBNAIL = "#job-list li:first-child img";

/** Mean brightness of the paper at the corners of the first page, which charts keep away from. */
async function paper(page) {
  const corners = await page.evaluate(() => {
    const { model, stage } = window.unwrapd.viewer;
    const at = (u, v) => stage.project("plane", model.sphere.center.clone().set(u * model.aspect, v, 0));
    return [at(0.003, 0.003), at(0.997, 0.003), at(0.003, 0.997), at(0.997, 0.997)];
  });
  return mean(await colors(page, corners));
}

/**
 * Colors of a picture of the report. The report is drawn again once the input is measured, too, which scrolls it back, and a picture
 * is drawn some frames after it is loaded unless it is decoded first.
 */
async function colorsInReport(page, name) {
  const selector = `#report img[alt^="${name}"]`;
  for (;;) {
    const picture = await page.waitForSelector(selector);
    await picture.evaluate(async (image) => {
      image.decoding = "sync";
      image.scrollIntoView({ block: "center" });
      await image.decode().catch(() => {});
    });
    const seen = await colorsOf(page, selector);
    const wasSeen = await picture.evaluate((image) => {
      const { top, bottom } = image.getBoundingClientRect();
      return image.isConnected && image.complete && 0 < image.naturalWidth && 0 <= top && bottom <= innerHeight;
    });
    if (wasSeen) return seen;
  }
}

/** Mean brightness of each part that is seen. */
async function parts(page) {
  const picture = page.locator(THUMBNAIL);
  await picture.evaluate((image) => image.decode());
  const seen = { surface: mean(await colorsOf(page, "#solid")), paper: await paper(page), thumbnail: mean(await colorsOf(page, THUMBNAIL, 12)) };
  await page.click("#tab-report");
  seen.layout = mean(await colorsInReport(page, "UV layout"));
  seen.heat = mean(await colorsInReport(page, "Heat map"));
  seen.report = mean(await colors(page, [[(await page.locator("#report").boundingBox()).x + 4, 300]]));
  await page.click("#tab-view");
  return seen;
}

export async function run(page, url) {
  await page.emulateMedia({ colorScheme: "light" });
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict");
  const light = await parts(page);
  for (const [name, bright] of Object.entries(light)) assert.ok(150 < bright, `${name} in the light: ${bright}`);
  await page.emulateMedia({ colorScheme: "dark" });
  const dark = await parts(page);
  for (const [name, bright] of Object.entries(dark)) assert.ok(bright < 110, `${name} in the dark: ${bright}`);
  // The button has the last word, also after a reload.
  await page.click("#theme");
  const chosen = await parts(page);
  for (const [name, bright] of Object.entries(chosen)) assert.ok(Math.abs(bright - light[name]) < 8, `${name} in the chosen light: ${bright} and ${light[name]}`);
  await page.reload();
  await shown(page);
  assert.ok(150 < (await paper(page)));
  return { light, dark };
}
