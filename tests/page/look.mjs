// What is seen on the page.
import assert from "node:assert/strict";

/** Waits until both views show a file. */
export async function shown(page, name) {
  await page.waitForSelector(name ? `#panes[data-shown=${JSON.stringify(name)}]` : "#panes[data-shown]", { state: "attached" });
  await settled(page);
}

/** Waits until nothing is drawn any more. */
export async function settled(page) {
  await page.evaluate(async () => {
    const { stage } = window.unwrapd.viewer;
    if (!stage) return;
    const frame = () => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn)));
    stage.solid.turn(false);
    for (let last = -1; last !== stage.figures.frames; await frame()) last = stage.figures.frames;
  });
}

/** The colors at places of the page, three numbers from 0 to 255 each. */
export async function colors(page, places) {
  await settled(page);
  const picture = (await page.screenshot()).toString("base64");
  return page.evaluate(async ([picture, places]) => {
    const image = new Image();
    image.src = `data:image/png;base64,${picture}`;
    await image.decode();
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    return places.map(([x, y]) => [...context.getImageData(Math.floor(x), Math.floor(y), 1, 1).data.slice(0, 3)]);
  }, [picture, places]);
}

/** Colors on a grid over an element. */
export async function colorsOf(page, selector, side = 24) {
  const box = await page.locator(selector).boundingBox();
  const step = (k, size) => ((k + 0.5) / side) * size;
  const places = Array.from({ length: side * side }, (_, k) => [box.x + step(k % side, box.width), box.y + step(Math.floor(k / side), box.height)]);
  return colors(page, places);
}

/** How many different colors there are. */
export function variety(some) {
  return new Set(some.map(String)).size;
}

export function difference(one, other) {
  return Math.max(...one.map((x, k) => Math.abs(x - other[k])));
}

export function assertDiffers(one, other, what) {
  assert.ok(16 < difference(one, other), `${what}: ${one} and ${other} are the same`);
}

export function assertSame(one, other, what) {
  assert.ok(difference(one, other) <= 6, `${what}: ${one} and ${other} differ`);
}

/** Where a face is on the page. */
export function project(page, view, face) {
  return page.evaluate(([view, face]) => window.unwrapd.viewer.project(view, face), [view, face]);
}

/** The attributes that say what is pointed at. */
export function pointed(page) {
  return page.evaluate(() => ({ ...document.getElementById("panes").dataset }));
}

/** Moves the pointer and waits for what it points at. */
export async function hover(page, place) {
  await page.mouse.move(...place);
  await settled(page);
  await settled(page);
  return pointed(page);
}

/** A face that is seen in both views, away from the edges of its neighbors on the screen, with where it is. */
export async function visibleFace(page, accept = () => true) {
  const faces = await page.evaluate(() => window.unwrapd.viewer.analysis.faces);
  for (let k = 1; k < 60; k++) {
    const face = Math.floor((k * faces) / 60);
    const [solid, plane] = [await project(page, "solid", face), await project(page, "plane", face)];
    if (!accept(face) || Number((await hover(page, solid)).hoverFace) !== face) continue;
    if (Number((await hover(page, plane)).hoverFace) === face) return { face, solid, plane };
  }
  throw new Error("no face is seen in both views");
}

/** Chooses a fill: a button, or an option of the list that takes the place of the buttons where other lists take their room. */
export async function fill(page, shade) {
  for (;;) {
    const isList = await page.isVisible("#fill");
    const chosen = isList ? page.selectOption("#fill", shade, { timeout: 10_000 }) : page.click(`button[data-shade=${shade}]`, { timeout: 10_000 });
    try {
      return await chosen;
    } catch (error) {
      // The lists appear once the file is read.
      if (error.name !== "TimeoutError") throw error;
    }
  }
}
