// A folder becomes a batch: a table of its jobs that can be sorted, a contact sheet, and all results in one ZIP.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { archive } from "../archive.mjs";
import { shown } from "../look.mjs";

/** Makes a folder of meshes, two of them of one name with files of one name, and one that is broken. */
function props(mesh, folder) {
  const made = mkdtempSync(join(tmpdir(), "props-"));
  cpSync(mesh, join(made, "head.obj"));
  for (const name of ["left", "right"]) cpSync(folder, join(made, name), { recursive: true });
  writeFileSync(join(made, "broken.obj"), "v 0 0 0\n");
  writeFileSync(join(made, ".hidden.obj"), "");
  return made;
}

/** Drops a file or a folder on the views, as from a file manager. */
async function drop(page, path) {
  const events = await page.context().newCDPSession(page);
  const data = { items: [], files: [path], dragOperationsMask: 1 };
  for (const type of ["dragEnter", "dragOver", "drop"]) await events.send("Input.dispatchDragEvent", { type, x: 600, y: 300, data });
}

const names = (page) => page.locator("#batch tbody th").allTextContents();
const cell = (page, name, key) => page.textContent(`#batch tbody tr:has(a:text-is("${name}")) td.${key}`);
const summary = (page, text) => page.waitForFunction((text) => document.querySelector("#batch header p")?.textContent === text, text);

export async function run(page, url, mesh, folder) {
  const made = props(mesh, folder);
  await page.goto(url);
  await shown(page, "spot.ply");
  await drop(page, made);
  await page.waitForFunction(() => document.querySelectorAll("#chosen li").length === 4);
  await gated(page);
  await page.click("#submit");
  await tabled(page, basename(made));
  await sorted(page);
  await pictured(page);
  await zipped(page);
  await opened(page);
  await archived(page);
  rmSync(made, { recursive: true });
}

/** Gates are set for all jobs of the batch, and kept. */
async function gated(page) {
  await page.click("#more > summary");
  await page.click("#gates > summary");
  await page.fill("#gate-max_charts", "1");
  await page.press("#gate-max_charts", "Tab");
  await page.check("#gate-certified");
  assert.equal(await page.textContent("#gated"), "2");
  await page.click("#more > summary");
}

/** The table has a row per job and totals. */
async function tabled(page, source) {
  await summary(page, "1 failed, 3 certified");
  assert.equal(await page.getAttribute("#tab-batch", "aria-selected"), "true");
  assert.ok((await page.textContent("#title")).startsWith(`${source} 20`));
  assert.deepEqual(await names(page), ["broken.obj", "head.obj", "left/BoxInterleaved.gltf", "right/BoxInterleaved.gltf"]);
  await page.waitForFunction(() => [...document.querySelectorAll("#batch tfoot td.faces")][0].textContent === "272");
  assert.equal(await cell(page, "left/BoxInterleaved.gltf", "faces"), "12");
  assert.equal(await cell(page, "left/BoxInterleaved.gltf", "stretch"), "0.0 %");
  assert.match(await cell(page, "head.obj", "energy"), /^4\.0\d\d$/);
  assert.match(await cell(page, "head.obj", "fill"), /^\d\d\.\d %$/);
  assert.equal(await cell(page, "broken.obj", "state"), "failed");
  assert.equal(await cell(page, "broken.obj", "faces"), "–");
  assert.equal(await cell(page, "broken.obj", "notes"), "The mesh has no triangle, misses certified,max_charts=1");
  for (const name of ["head.obj", "left/BoxInterleaved.gltf"]) {
    const meets = (await cell(page, name, "charts")) === "1";
    assert.match(await cell(page, name, "notes"), meets ? /meets certified,max_charts=1/ : /misses certified,max_charts=1/);
  }
  assert.match(await page.textContent("#batch tfoot td.notes"), /^\d of 4 accepted$/);
  await page.click("text=Retry 1 failed");
  await summary(page, "1 failed, 3 certified");
}

/** A column sorts in both directions, by the keyboard too; what has no number is last. The address keeps it. */
async function sorted(page) {
  await page.click("#batch thead th.faces button");
  assert.deepEqual(await names(page), ["left/BoxInterleaved.gltf", "right/BoxInterleaved.gltf", "head.obj", "broken.obj"]);
  assert.equal(await page.getAttribute("#batch thead th.faces", "aria-sort"), "ascending");
  // The button has the focus still, though the table is another one.
  await page.keyboard.press("Enter");
  assert.deepEqual(await names(page), ["head.obj", "left/BoxInterleaved.gltf", "right/BoxInterleaved.gltf", "broken.obj"]);
  assert.equal(await page.getAttribute("#batch thead th.faces", "aria-sort"), "descending");
  await page.reload();
  await page.waitForFunction(() => document.querySelector("#batch tbody th")?.textContent === "head.obj");
}

/** The contact sheet has a picture of each layout. */
async function pictured(page) {
  await page.click("text=Contact sheet");
  await page.waitForFunction(() => {
    const pictures = [...document.querySelectorAll(".contact-sheet img")];
    return pictures.length === 3 && pictures.every(({ naturalWidth }) => 0 < naturalWidth);
  });
  assert.equal(await page.textContent(".contact-sheet .none"), "failed");
  await page.click("#batch >> text=Table");
}

/** The ZIP has each result in the folder of its input. */
async function zipped(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("text=Download 3 results as ZIP")]);
  const zip = readFileSync(await download.path());
  assert.equal(zip.readUInt16LE(zip.length - 12), 3, "entries of the archive");
  for (const name of ["head.glb", "left/BoxInterleaved.glb", "right/BoxInterleaved.glb"]) assert.ok(zip.includes(name), name);
  assert.match(download.suggestedFilename(), /^props-.*\.zip$/);
}

/** A row opens its job in the views, and the browser goes back to the table. A job without a batch has no table. */
async function opened(page) {
  await page.click("text=left/BoxInterleaved.gltf");
  await page.waitForFunction(() => document.querySelector("#title").textContent === "BoxInterleaved.gltf");
  await shown(page);
  assert.ok(await page.isVisible("#panes"));
  await page.goBack();
  await page.waitForSelector("#batch table");
  await page.click("#tab-view");
  await page.setInputFiles("#files", { name: "one.obj", mimeType: "model/obj", buffer: Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") });
  await shown(page, "one.obj");
  await page.click("#submit");
  await page.waitForSelector(".verdict.certified");
  await page.waitForFunction(() => document.querySelector("#title").textContent === "one.obj");
  assert.ok(await page.isHidden("#tab-batch"));
}

/** A ZIP of several meshes is a batch; a job that is refused keeps none of the others. */
async function archived(page) {
  const [good, other] = ["one.obj", "deep/two.obj"].map((name) => ({ name, content: Buffer.from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") }));
  await page.setInputFiles("#files", { name: "pair.zip", mimeType: "application/zip", buffer: archive([good, other, { name: "last.glb", content: Buffer.from("no mesh") }]) });
  await page.waitForFunction(() => document.querySelectorAll("#chosen li").length === 3);
  await page.click("#submit");
  await page.waitForSelector("#batch .refused");
  assert.match(await page.textContent("#batch .refused"), /1 file refused\. last\.glb: /);
  await summary(page, "2 certified");
  assert.ok(await page.isVisible("#batch .refused"));
  assert.deepEqual((await names(page)).toSorted(), ["deep/two.obj", "one.obj"]);
}
