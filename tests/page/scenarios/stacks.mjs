// Charts of certified stacks overlap on purpose: the page says so, and nothing as missing.
import assert from "node:assert/strict";
import { shown } from "../look.mjs";

export async function run(page, url) {
  await page.goto(url);
  await shown(page);
  const claims = await page.locator(".claims li").evaluateAll((rows) => rows.map((row) => [row.className, row.textContent]));
  assert.ok(claims.some(([, text]) => text.endsWith("No two faces overlap except in 1 stack")), JSON.stringify(claims));
  assert.deepEqual(claims.filter(([name]) => name !== "holds"), []);
}
