// The pictures of the page's README: run it by hand as `node drive.mjs pictures URL FOLDER MAPPED`, with Spot unwrapped at the URL, and the fox, which had
// UVs before, at the other one.
import { join } from "node:path";
import { hover, settled, shown, visibleFace } from "../look.mjs";

export async function run(page, url, folder, mapped) {
  const take = async (name) => {
    await settled(page);
    await page.screenshot({ path: join(folder, `page-${name}.png`) });
  };
  const fill = (shade) => page.click(`button[data-shade=${shade}]`);
  await page.goto(new URL("/", url).href);
  await shown(page, "spot.ply");
  await page.click("#more > summary");
  await page.waitForSelector("#options .option");
  await take("first");
  await page.click("#more > summary");
  await page.goto(url);
  await shown(page);
  await page.waitForSelector(".verdict");
  const { solid } = await visibleFace(page);
  await hover(page, solid);
  await take("charts");
  await page.mouse.move(640, 20);
  for (const shade of ["checker", "heat"]) {
    await fill(shade);
    await take(shade);
  }
  await fill("padding");
  await page.fill("#mip", "4");
  await page.press("#mip", "Enter");
  await take("padding");
  await fill("charts");
  await page.click("#arrange");
  await page.keyboard.press("n");
  await take("arrange");
  await page.click("#arrange");
  await page.click("#tab-report");
  await page.waitForSelector(".certificate");
  await take("report");
  await pulled(page, take);
  await page.goto(mapped);
  await page.reload();
  await shown(page);
  await page.waitForSelector(".verdict");
  await page.click("text=Side by side");
  await page.waitForSelector("#panes.both");
  await take("beside");
}

/** UVs are pulled, and their surface shows it. */
async function pulled(page, take) {
  await page.click("#tab-pull");
  await page.selectOption("#pull-way", { label: "UVs" });
  await page.click("#pull-start");
  await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
  const box = await page.locator("#pull-pane .pane:visible").first().boundingBox();
  const at = (x, y) => [box.x + x * box.width, box.y + y * box.height];
  await page.mouse.click(...at(0.3, 0.45));
  await page.mouse.click(...at(0.4, 0.55));
  await page.mouse.move(...at(0.35, 0.5));
  await page.mouse.down();
  await page.mouse.move(...at(0.37, 0.47), { steps: 8 });
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("at rest"));
  await take("pull");
}
