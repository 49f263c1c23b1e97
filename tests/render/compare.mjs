// Reads pairs of paths of glTF files, one pair per line with a tab between, renders both of each with three.js in a
// headless Chromium, and prints for each pair how far the pictures are apart, as JSON. With a folder as argument it
// leaves the pictures there.
import { spawn } from "node:child_process";
import { createReadStream, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { basename, dirname, extname, join, normalize } from "node:path";
import { setTimeout as wait } from "node:timers/promises";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const three = join(here, "node_modules", "three");
const folder = process.argv[2];
const pairs = readFileSync(0, "utf8").split("\n").filter(Boolean).map((line) => line.split("\t"));
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm", ".png": "image/png", ".jpg": "image/jpeg" };

// A file's folder is part of its address, so that what it references is found.
const address = (path, pair, side) => `/files/${pair}/${side}/${basename(path)}`;

function fileOf(path) {
  if (path === "/page.html") return join(here, "page.html");
  const [, root, ...rest] = normalize(path).split("/");
  if (root === "three") return join(three, ...rest);
  if (root === "files") return join(dirname(pairs[rest[0]][rest[1]]), ...rest.slice(2));
}

async function posted(request) {
  const chunks = [];
  for await (const chunk of request) chunks.push(chunk);
  return Buffer.concat(chunks).toString();
}

let compared = 0;
const server = createServer(async (request, response) => {
  const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
  if (path === "/pairs") {
    response.end(JSON.stringify(pairs.map((paths, pair) => paths.map((path, side) => address(path, pair, side)))));
  } else if (path === "/compared") {
    const { pictures = [], ...answer } = JSON.parse(await posted(request));
    console.log(JSON.stringify(answer));
    pictures.forEach((picture, side) => {
      const name = `${compared}-${basename(pairs[compared][side])}-${["before", "after"][side]}.png`;
      if (folder) writeFileSync(join(folder, name), Buffer.from(picture.split(",")[1], "base64"));
    });
    compared += 1;
    response.end();
  } else if (path === "/done") {
    response.end();
    browser.kill();
  } else {
    const file = fileOf(path);
    if (!file) return response.writeHead(404).end();
    response.setHeader("content-type", types[extname(file)] ?? "application/octet-stream");
    createReadStream(file).on("error", () => response.writeHead(404).end()).pipe(response);
  }
});
await new Promise((listening) => server.listen(0, "127.0.0.1", listening));

const profile = mkdtempSync(join(tmpdir(), "unwrapd-render-"));
const flags = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"];
const browser = spawn("chromium", [...flags, `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/page.html`], { stdio: "ignore" });
const limit = setTimeout(() => browser.kill(), 300_000);
await new Promise((ended) => browser.on("exit", ended).on("error", ended));
clearTimeout(limit);
server.closeAllConnections();
server.close();
// The browser's other processes may write a little longer than it lives.
for (let tries = 1; ; tries += 1) {
  try {
    rmSync(profile, { recursive: true, force: true });
    break;
  } catch (error) {
    if (tries === 40) throw error;
    await wait(250);
  }
}
process.exitCode = compared === pairs.length ? 0 : 1;
