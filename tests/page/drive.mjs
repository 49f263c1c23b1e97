// `node drive.mjs SCENARIO URL [ARGUMENT…]` opens the page at an address in a fresh browser and runs a scenario, which throws if
// something is not as it must be. What it returns is printed as JSON.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const [name, url, ...given] = process.argv.slice(2);
const scenario = await import(`./scenarios/${name}.mjs`);

const profile = mkdtempSync(join(tmpdir(), "unwrapd-page-"));
const flags = ["--no-sandbox", "--disable-gpu", "--disable-background-networking"];
const context = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  headless: true,
  args: [...flags, ...(scenario.flags ?? [])],
  viewport: { width: 1280, height: 800 },
  permissions: ["clipboard-read", "clipboard-write"],
});
// Beside other work a page takes minutes; the budget of the test ends one that hangs.
context.setDefaultTimeout(300_000);
const errors = [];
try {
  const page = await context.newPage();
  // Nothing is loaded from elsewhere.
  page.on("request", (request) => {
    const { protocol, hostname } = new URL(request.url());
    if (["http:", "https:"].includes(protocol) && hostname !== "127.0.0.1") errors.push(`asked ${hostname}`);
  });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error" && !/Failed to load resource/.test(message.text())) errors.push(message.text());
  });
  const said = await scenario.run(page, url, ...given);
  console.log(JSON.stringify(said ?? null));
  if (errors.length && !scenario.hasErrors) throw new Error(`the console has errors: ${errors.join("; ")}`);
} finally {
  await context.close();
  rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 250 });
}
