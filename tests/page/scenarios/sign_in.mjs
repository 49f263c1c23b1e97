// Where the service asks for a key, so does the page, and keeps it nowhere.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export const hasErrors = true;

export async function run(page, url, key, mesh) {
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.goto(url);
  await page.waitForSelector("#sign-in[open]");
  await page.keyboard.press("Escape");
  await page.goto(url);
  await page.fill("#sign-in-key", "uw_0123456789abcdef_00");
  await page.click("#sign-in >> text=Sign in >> nth=-1");
  await page.waitForSelector("#sign-in .wrong >> text=does not know this key");
  await page.fill("#sign-in-key", key);
  await page.keyboard.press("Enter");
  await page.waitForSelector("#sign-in", { state: "hidden" });
  await page.waitForSelector("#caller button");

  // Calls, pictures and events of a job need no more than the cookie.
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
  await page.click("#submit");
  await page.waitForSelector(".verdict.certified");
  await page.waitForFunction(() => document.querySelector(".row-link img")?.naturalWidth === 72);
  await page.click("text=Copy as curl");
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(copied, /"Authorization: Bearer \$UNWRAPD_KEY"/);
  const [, , secret] = key.split("_");
  const kept = await page.evaluate(() => JSON.stringify([document.cookie, { ...localStorage }, { ...sessionStorage }, document.body.outerHTML, location.href]));
  for (const place of [kept, copied, ...asked]) assert.ok(!place.includes(secret));
  assert.ok(!kept.includes("unwrapd-key"));
  const [cookie] = await page.context().cookies();
  assert.ok(cookie.httpOnly && cookie.sameSite === "Strict" && !cookie.value.includes(secret));

  // It holds after a reload, and nothing is left after signing out.
  await page.reload();
  await shown(page);
  await page.click("#caller button");
  await page.waitForSelector("#sign-in[open]");
  assert.equal(await page.locator(".row-link").count(), 0);
  assert.deepEqual(await page.context().cookies(), []);
}
