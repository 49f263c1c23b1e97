// Every pane has room at every width and keeps it under a legend, the tools are in one row, and a person can give either view more room.
import assert from "node:assert/strict";
import { fill, shown, settled, colorsOf, variety } from "../look.mjs";

/** Widths of a phone, a tablet, two laptops and a large screen, with the least visible width and height of each pane. */
const WIDTHS = [[390, 390, 200], [768, 380, 400], [1024, 270, 500], [1280, 400, 500], [1440, 440, 500], [2560, 950, 500]];

/** The part of an element that is on the screen. */
async function visible(page, selector) {
  const { x, y, width, height } = await page.locator(selector).boundingBox();
  const screen = page.viewportSize();
  return [Math.min(x + width, screen.width) - Math.max(x, 0), Math.min(y + height, screen.height) - Math.max(y, 0)];
}

/** Whether all tools that are seen are in one row. */
async function areInOneRow(page, screen, when) {
  const tools = await page.evaluate(() => [...document.querySelectorAll("#toolbar > *")].map((one) => one.getBoundingClientRect()).filter(({ height }) => height).map(({ top, bottom }) => (top + bottom) / 2));
  assert.ok(5 < tools.length && Math.max(...tools) - Math.min(...tools) < 8, `one row of tools at ${screen} ${when}: ${tools}`);
}

/** A legend comes and goes over the views, which stay as they are. */
async function keepsRoom(page, screen) {
  const before = await page.locator("#panes").boundingBox();
  for (const shade of ["heat", "checker"]) {
    await page.click(`button[data-shade=${shade}]`);
    const legend = await page.locator("#legend").boundingBox();
    assert.deepEqual(await page.locator("#panes").boundingBox(), before, `the views under the legend of ${shade} at ${screen}`);
    assert.ok(before.x <= legend.x && legend.x + legend.width <= before.x + before.width && legend.height < (screen < 1280 ? 80 : 42), `rows of the legend at ${screen}: ${JSON.stringify(legend)}`);
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("#legend *")].filter(({ scrollWidth, clientWidth }) => clientWidth && clientWidth < scrollWidth).map(({ className }) => className)), [], `nothing of the legend is cut off at ${screen}`);
  }
  await page.click("button[data-shade=charts]");
  assert.ok(await page.isHidden("#legend"));
}

const width = async (page, pane) => (await page.locator(pane).boundingBox()).width;

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  for (const [screen, least, high] of WIDTHS) {
    await page.setViewportSize({ width: screen, height: 844 });
    await settled(page);
    for (const pane of ["#solid", "#plane"]) {
      const [w, h] = await visible(page, pane);
      assert.ok(least <= w && high <= h, `${pane} at ${screen}: ${w} by ${h}`);
    }
    for (const shade of ["heat", "charts"]) {
      await fill(page, shade);
      assert.equal(await page.evaluate(() => window.unwrapd.store.place.shade), shade, `the fill at ${screen}`);
    }
    if (768 <= screen) await keepsRoom(page, screen);
    if (screen < 1280) continue;
    await areInOneRow(page, screen, "");
    const views = await page.locator("#panes").boundingBox();
    await page.click("#arrange");
    await areInOneRow(page, screen, "while islands are arranged");
    assert.deepEqual(await page.locator("#panes").boundingBox(), views, `the views while islands are arranged at ${screen}`);
    await page.selectOption("#fill", "heat");
    await page.selectOption("#fill", "charts");
    await page.click("#arrange");
  }
  await page.setViewportSize({ width: 1440, height: 844 });
  await settled(page);
  // One view alone, then both again, by key and button.
  const half = await width(page, "#plane");
  await page.locator("#plane").hover();
  await page.keyboard.press("m");
  await settled(page);
  assert.ok(await page.isHidden("#plane"));
  assert.ok(1.9 * half < (await width(page, "#solid")));
  assert.ok(4 < variety(await colorsOf(page, "#solid")), "the surface is drawn alone");
  await page.click("button[data-alone=plane]");
  await settled(page);
  assert.ok(await page.isHidden("#solid"));
  assert.ok(4 < variety(await colorsOf(page, "#plane")), "the UVs are drawn alone");
  await page.click("button[data-alone=plane]");
  // The divider, by pointer and by keys; what was set survives a reload.
  const { x, y, height } = await page.locator("#divider").boundingBox();
  await page.mouse.move(x + 4, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + 4 + 0.4 * half, y + height / 2, { steps: 5 });
  await page.mouse.up();
  await settled(page);
  assert.ok(Math.abs((await width(page, "#plane")) - 0.6 * half) < 12, "the UVs have less room");
  await page.focus("#divider");
  await page.keyboard.press("ArrowRight");
  await settled(page);
  const narrow = await width(page, "#plane");
  assert.ok(Math.abs(narrow - 0.5 * half) < 12, `${narrow} of ${half}`);
  await page.reload();
  await shown(page);
  assert.equal(await width(page, "#plane"), narrow);
  assert.ok(4 < variety(await colorsOf(page, "#plane")), "the UVs are drawn there");
}
