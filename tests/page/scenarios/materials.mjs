// The materials of an OBJ file are seen, with their pictures; what is missing is not black.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { colorsOf, shown, variety } from "../look.mjs";

const OBJ = `mtllib my colors.mtl
v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 1 -1 1\nv 3 -1 1\nv 3 1 1\nv 1 1 1
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 1.1 0.1\nvt 1.9 0.1\nvt 1.9 0.9\nvt 1.1 0.9
usemtl picture\nf 1/1 2/2 3/3 4/4\nusemtl red\nf 5/5 6/6 7/7 8/8
`;
const MTL = "newmtl picture\nKd 1 1 1\nmap_Kd textures\\spot.png\nnewmtl red\nKd 0.9 0.05 0.05\nmap_Kd none.tga\n";
const file = (name, text) => ({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
const isRed = ([r, g, b]) => 120 < r && g < 0.6 * r && b < 0.6 * r;

export async function run(page, url, picture) {
  const png = { name: "spot.png", mimeType: "image/png", buffer: readFileSync(picture) };
  await page.goto(url);
  await shown(page, "spot.ply");
  const seen = async (files, name) => {
    await page.setInputFiles("#files", files);
    await shown(page, name);
    await page.click("button[data-shade=material]");
    return colorsOf(page, "#solid");
  };
  const plain = await seen([file("plain.obj", OBJ)], "plain.obj");
  assert.equal(plain.filter(isRed).length, 0);
  // A material without its picture has its color.
  const red = await seen([file("red.obj", OBJ), file("my colors.mtl", MTL)], "red.obj");
  assert.ok(10 < red.filter(isRed).length, "the red square is red");
  assert.match(await page.textContent("#legend"), /Not shown: textures.spot\.png, none\.tga/);
  assert.match(await page.textContent("#inspector"), /Pictures not shown/);
  const full = await seen([file("full.obj", OBJ), file("my colors.mtl", MTL), png], "full.obj");
  assert.ok(10 < full.filter(isRed).length);
  assert.ok(variety(red) + 20 < variety(full), `the picture is seen: ${variety(red)} and ${variety(full)} colors`);
  assert.ok(20 < variety(await colorsOf(page, "#plane")), "also below the UVs");
  assert.equal(await page.textContent("#legend"), "Not shown: none.tga");
  assert.ok(await page.isHidden("#problem"));
}
