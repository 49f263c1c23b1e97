// Pictures of every view and state, light and dark, at three widths, to be looked at: run it by hand as `node drive.mjs tour URL FOLDER FILES…`, with a
// job of a mesh that had UVs at the URL, and files of which each is chosen.
import { basename, join } from "node:path";
import { fill, settled, shown, visibleFace } from "../look.mjs";

export const hasErrors = true;
const WIDTHS = [[1440, 900], [1024, 768], [390, 844]];

export async function run(page, url, folder, ...files) {
  page.setDefaultTimeout(60_000);
  for (const [width, height] of WIDTHS) {
    for (const colorScheme of ["light", "dark"]) {
      await page.setViewportSize({ width, height });
      await page.emulateMedia({ colorScheme });
      const take = async (name, options = {}) => {
        await settled(page);
        await page.screenshot({ path: join(folder, `${width}-${colorScheme}-${name}.png`), ...options });
      };
      try {
        await states(page, url, files, take, width);
      } catch (error) {
        console.error(width, colorScheme, error.message);
        await take("broken");
      }
    }
  }
}

async function states(page, url, files, take, width) {
  const home = new URL("/", url).href;
  await page.goto("about:blank");
  await page.goto(home);
  await shown(page, "spot.ply");
  await take("first");
  await page.click("#more > summary");
  await page.waitForSelector("#options .option");
  await take("options", { fullPage: width < 961 });
  await page.click("#more > summary");
  await page.goto("about:blank");
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict");
  for (const shade of ["plain", "charts", "checker", "heat", "material", "padding"]) {
    await fill(page, shade);
    await take(shade);
  }
  await fill(page, "charts");
  await page.click("button[data-switch=wire]");
  const { plane } = await visibleFace(page);
  await page.mouse.click(...plane);
  await take("selected", { fullPage: width < 961 });
  await page.click("button[data-switch=wire]");
  await page.keyboard.press("b");
  await page.waitForSelector("#title-state:not(:empty)");
  await shown(page);
  await take("before");
  await page.keyboard.press("b");
  await shown(page);
  await page.keyboard.press("d");
  await page.waitForSelector("#panes.both");
  await take("beside", { fullPage: width < 961 });
  await page.keyboard.press("d");
  await page.waitForSelector("#panes:not(.both)");
  await page.keyboard.press("m");
  await take("alone");
  await page.keyboard.press("m");
  await page.keyboard.press("m");
  await page.click("#arrange");
  await page.keyboard.press("n");
  await take("arrange");
  await page.click("#arrange");
  await page.keyboard.press("?");
  await take("keys");
  await page.keyboard.press("Escape");
  await page.click("#tab-report");
  await page.waitForSelector(".certificate");
  await page.waitForTimeout(1500);
  await take("report");
  await page.evaluate(() => document.querySelector("#report .figures")?.scrollIntoView());
  await take("report2");
  await page.evaluate(() => { const report = document.querySelector("#report"); report.scrollTop = report.scrollHeight; document.querySelector("#report").lastElementChild.scrollIntoView({ block: "end" }); });
  await page.waitForTimeout(800);
  await take("report3");
  await page.evaluate(() => scrollTo(0, 0));
  await page.click("#tab-pull");
  await page.waitForTimeout(300);
  await take("pull0");
  await page.selectOption("#pull-way", { label: "UVs" });
  await page.click("#pull-start");
  await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
  const box = await page.locator("#pull-pane .pane:visible").first().boundingBox();
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  await page.mouse.click(...at(0.3, 0.45));
  await page.mouse.move(...at(0.35, 0.5));
  await page.mouse.down();
  await page.mouse.move(...at(0.45, 0.42), { steps: 8 });
  await page.mouse.up();
  await page.waitForTimeout(600);
  await take("pull");
  await page.click("#pull-tools button:has-text('End')");
  await page.click("#tab-view");
  for (const file of files) {
    await page.goto("about:blank");
    await page.goto(home);
    await shown(page, "spot.ply");
    await page.setInputFiles("#files", file);
    await page.waitForTimeout(2500);
    if (/texture|milk/i.test(file)) await fill(page, "material");
    await take(`file-${basename(file)}`);
  }
  await page.goto(`${home}#job=01900000-0000-7000-8000-000000000000`);
  await page.reload();
  await page.waitForSelector("#problem:not([hidden])");
  await take("missing");
  await page.route(/\/v1\//, (route) => route.abort());
  await page.reload();
  await page.waitForSelector("#connection:not([hidden])");
  await take("gone");
  await page.unroute(/\/v1\//);
  await page.goto(`${home}docs`);
  await page.waitForSelector(".opblock");
  await page.screenshot({ path: undefined });
  await page.goto(home);
  await shown(page, "spot.ply");
}
