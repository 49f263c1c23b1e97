// A service is killed while a job runs. The page says that it is gone, finds it again, and shows the charts of the job as it goes on.
import assert from "node:assert/strict";
import { kill, restart } from "../service.mjs";

// A service that is gone tells in the console that it was asked for.
export const hasErrors = true;

export async function run(page, url) {
  await page.goto(url);
  await page.waitForSelector("#relaxing:not(:empty)");
  await page.waitForSelector(".stages li");
  await kill();
  await page.waitForSelector("#connection:not([hidden])");
  assert.match(await page.textContent("#connection"), /does not answer/);
  const charts = page.waitForResponse((answer) => answer.url().includes("/maps?") && answer.status() === 200);
  // Sockets that are opened before the service is back hear nothing; the page opens another one each second.
  const event = new Promise((heard) => page.on("websocket", (socket) => socket.on("framereceived", heard)));
  await restart();
  await page.waitForSelector("#connection", { state: "hidden" });
  await event;
  await charts;
  await page.waitForSelector("#relaxing:not(:empty)");
  await page.waitForFunction(() => document.querySelector(".progress-panel .stage").textContent === "Relaxing charts");
  await page.click(`.progress-panel button:text-is("Cancel")`);
  await page.waitForSelector(".verdict.cancelled");
  assert.ok(await page.isHidden("#problem"));
}
