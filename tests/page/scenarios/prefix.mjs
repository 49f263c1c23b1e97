// Behind a proxy that adds a prefix, everything still works.
import assert from "node:assert/strict";
import { createServer, request } from "node:http";
import { connect } from "node:net";
import { shown } from "../look.mjs";
import { tried } from "./api.mjs";

const PREFIX = "/tools/uv";

/** Passes on what is below the prefix, and nothing else. */
function proxy(target) {
  const server = createServer((asked, answer) => {
    if (!asked.url.startsWith(`${PREFIX}/`)) return answer.writeHead(404).end();
    const { method, headers } = asked;
    const passed = request(new URL(asked.url.slice(PREFIX.length), target), { method, headers }, (answered) => {
      answer.writeHead(answered.statusCode, answered.headers);
      answered.pipe(answer);
    });
    asked.pipe(passed);
  });
  server.on("upgrade", (asked, socket) => {
    const passed = connect(new URL(target).port, "127.0.0.1", () => {
      const headers = Object.entries(asked.headers).map(([name, value]) => `${name}: ${value}\r\n`);
      passed.write(`GET ${asked.url.slice(PREFIX.length)} HTTP/1.1\r\n${headers.join("")}\r\n`);
      socket.pipe(passed).pipe(socket);
    });
    for (const one of [passed, socket]) one.on("error", () => one.destroy());
  });
  return new Promise((listening) => server.listen(0, "127.0.0.1", () => listening(server)));
}

export async function run(page, url, mesh) {
  const server = await proxy(url);
  const missed = [];
  page.on("response", (answer) => answer.status() === 404 && missed.push(answer.url()));
  await page.goto(`http://127.0.0.1:${server.address().port}${PREFIX}/`);
  await shown(page, "spot.ply");
  await page.setInputFiles("#files", mesh);
  await shown(page, mesh.split("/").pop());
  await page.click("#submit");
  await page.waitForSelector(".verdict.certified");
  await shown(page);
  await page.click("nav >> text=API");
  await page.waitForSelector(".opblock");
  assert.equal(await tried(page, "service", "healthz"), "200");
  assert.deepEqual(missed, []);
  server.closeAllConnections();
  server.close();
}
