// A mesh is held and dragged by the mouse; every frame that the page got is judged by its bytes. Undo, bake, keys.
import assert from "node:assert/strict";
import { basename } from "node:path";
import { frameOf, flips, meshOf } from "../live.mjs";

export async function run(page, url, file, what, place, picture) {
  const frames = [];
  let mesh = null;
  let said = 0;
  let live = null;
  page.on("websocket", (socket) => {
    if (!socket.url().includes("/v1/sessions/")) return;
    live = socket;
    socket.on("framesent", ({ payload }) => (said = JSON.parse(payload).n));
    socket.on("framereceived", ({ payload }) => {
      if (typeof payload === "string") return;
      if (payload[0] === 1) mesh = meshOf(payload);
      else frames.push(frameOf(payload));
    });
  });
  await page.goto(url);
  await page.waitForSelector("#panes[data-shown]");
  await page.click("#tab-pull");
  await page.setInputFiles("#pull-files", file);
  assert.equal(await page.textContent("#title"), basename(file));
  await page.selectOption("#pull-way", { label: what });
  await page.click("#pull-start");
  await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("0 flips"));
  const box = await page.locator("#pull-pane .pane:visible").boundingBox();
  const at = ([x, y]) => [box.x + x * box.width, box.y + y * box.height];
  const [held, dragged, target] = JSON.parse(place).map(at);
  await page.mouse.click(...held);
  await page.waitForSelector(".grip");
  await page.mouse.move(...dragged);
  await page.mouse.down();
  await page.mouse.move(...target, { steps: 25 });
  await page.mouse.up();
  assert.equal(await page.locator(".grip").count(), 2);
  // The page may still say that it is at rest after the drag before.
  const rest = async () => {
    while (frames.at(-1).isMoving || frames.at(-1).message < said) await live.waitForEvent("framereceived");
    await page.waitForFunction(() => document.querySelector("#pull-figures").textContent.includes("at rest"));
  };
  await rest();
  const far = farthest(frames.at(-1), mesh);
  assert.ok(far > 0.05, `it followed: ${far}`);
  if (picture) await page.screenshot({ path: picture });

  // Keys: the dragged handle is grabbed without a button and put back, turned, then all is undone.
  await page.keyboard.press("g");
  await page.mouse.move(target[0] + 40, target[1] + 30, { steps: 5 });
  await page.keyboard.press("Escape");
  await page.keyboard.press("Tab");
  await page.keyboard.press("l");
  await page.waitForSelector(".grip.locked");
  await page.keyboard.press("l");
  await page.keyboard.press("Control+z");
  await page.waitForFunction(() => document.querySelectorAll(".grip").length < 2);
  await page.keyboard.press("Control+Shift+z");
  await page.waitForFunction(() => document.querySelectorAll(".grip").length === 2);
  await rest();
  assert.ok(frames.length > 10, `${frames.length} frames`);
  for (const frame of frames) assert.deepEqual([frame.flips, flips(mesh, frame)], [0, 0]);

  await page.keyboard.press("b");
  await page.waitForSelector("#inspector .verdict");
  const text = await page.textContent("#inspector");
  assert.ok(!/failed/i.test(text), text);
  return { frames: frames.length, elements: mesh.elements.length / mesh.corners, far, text: text.slice(0, 80) };
}

/** The farthest that a vertex is from its place at rest, as a share of the mesh's size. */
function farthest(frame, { dim, rest }) {
  let far = 0;
  for (let v = 0; v < rest.length; v += dim) {
    far = Math.max(far, Math.hypot(...Array.from({ length: dim }, (_, k) => frame.positions[v + k] - rest[v + k])));
  }
  const sides = Array.from({ length: dim }, (_, k) => rest.filter((_, i) => i % dim === k)).map((all) => all.reduce((m, x) => Math.max(m, x), -Infinity) - all.reduce((m, x) => Math.min(m, x), Infinity));
  return far / Math.max(...sides);
}
