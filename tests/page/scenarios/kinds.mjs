// Jobs of every kind are shown, with what they made.
import assert from "node:assert/strict";

export async function run(page, url, ...jobs) {
  for (const job of jobs) {
    const [id, ...words] = job.split("|");
    await page.goto(`${url}#job=${id}`);
    await page.reload();
    await page.waitForSelector("#inspector .verdict");
    const text = await page.textContent("body");
    for (const word of words) assert.ok(text.includes(word), `${word}: ${text.slice(0, 4000)}`);
  }
}
