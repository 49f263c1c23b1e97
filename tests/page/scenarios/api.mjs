// The OpenAPI document in its viewer: every operation is there and can be tried out, and problems link to their codes.
import assert from "node:assert/strict";

/** Tries an operation out and returns what the viewer shows of the answer. */
export async function tried(page, tag, operation) {
  const block = page.locator(`#operations-${tag}-${operation}`);
  await block.locator(".opblock-summary-control").click();
  await block.locator("button:has-text('Try it out')").click();
  await block.locator("button.execute").click();
  return block.locator(".live-responses-table .response-col_status").nth(1).textContent();
}

export async function run(page, url) {
  const api = await (await fetch(`${url}openapi.json`)).json();
  const operations = [api.paths, api.webhooks].flatMap(Object.values).flatMap(Object.values);
  await page.goto(`${url}docs`);
  await page.waitForSelector(".opblock");
  assert.equal(await page.locator(".opblock").count(), operations.length);
  assert.equal(await tried(page, "service", "healthz"), "200");

  await page.goto("about:blank");
  await page.goto(`${url}docs#no_such_file`);
  await page.waitForFunction(() => document.getElementById("no_such_file")?.getBoundingClientRect().top < innerHeight);
  return { operations: operations.length };
}
