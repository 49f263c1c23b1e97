// A job runs: each stage has a bar, and the time that is left is told. Then its service is killed. The page says that it is gone, finds it again, and shows the charts of the job as it goes on.
import assert from "node:assert/strict";
import { kill, restart } from "../service.mjs";

// A service that is gone tells in the console that it was asked for.
export const hasErrors = true;

/** A fact of the running job. */
const fact = (page, name) => page.evaluate((name) => [...document.querySelectorAll(".progress-panel dt")].find(({ textContent }) => textContent === name).nextSibling.textContent, name);

export async function run(page, url, before) {
  // A renderer in software that turns a large surface leaves no time for anything else.
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.goto(url);
  await page.waitForSelector(".progress-panel");
  // The job has waited behind another one for the page.
  await page.request.delete(new URL(before, url).href);
  await page.waitForSelector("#relaxing:not(:empty)");
  // Stages that the page has seen end have full bars, and the one under way a part of one.
  const bars = await page.evaluate(() => [...document.querySelectorAll(".stages progress")].map(({ value }) => value));
  assert.ok(0 < bars.at(-1) && bars.at(-1) < 1 && bars.slice(0, -1).every((value) => value === 1), String(bars));
  while (!/^about ([\d,]+ s|\d+ min \d+ s)$/.test(await fact(page, "Time left"))) await page.waitForTimeout(200);
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
