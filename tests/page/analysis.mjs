// What the page computes itself, on maps whose numbers are known. It runs the worker of the bundle, without a browser.
import assert from "node:assert/strict";

const worker = new URL("../../src/server/src/http/page/dist/worker.js", import.meta.url);

/** The worker as a function. */
async function analyst() {
  let answered;
  globalThis.self = { postMessage: (answer) => answered(answer) };
  await import(worker);
  return (soup) => new Promise((resolve, reject) => {
    answered = ({ analysis, error }) => (analysis ? resolve(analysis) : reject(new Error(error)));
    globalThis.self.onmessage({ data: { id: 1, soup } });
  });
}

const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** A soup of faces, each three corners with a place and a UV. */
function soup(faces, padding = 0) {
  const positions = Float32Array.from(faces.flat().flatMap(([place]) => place));
  const uvs = Float32Array.from(faces.flat().flatMap(([, uv]) => uv));
  const part = { positions, uvs, normals: null, matrix: IDENTITY, mesh: 0, primitive: 0, group: 0, copyOf: -1 };
  return { parts: [part], groups: [{ name: "scene", label: "scene" }], texture: { width: 1000, height: 1000, padding }, inScene: false };
}

/** A square of 2n² faces, placed and mapped by functions of its own coordinates. */
function square(n, place, uv) {
  const corner = (i, j) => [place(i / n, j / n), uv(i / n, j / n)];
  const cells = Array.from({ length: n * n }, (_, k) => [k % n, Math.floor(k / n)]);
  return cells.flatMap(([i, j]) => {
    const [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
    return [[a, b, c], [a, c, d]];
  });
}

const flat = (x, y) => [x, y, 0];
const near = (one, other, tolerance = 1e-5) => assert.ok(Math.abs(one - other) <= tolerance * Math.abs(other), `${one} is not ${other}`);
const analyze = await analyst();

async function stretched() {
  // Twice as long along u: with equal areas the singular values are √2 and 1/√2.
  const { atlases: [atlas], charts } = await analyze(soup(square(8, flat, (x, y) => [0.5 * x, 0.25 * y])));
  assert.deepEqual([atlas.faces, charts, atlas.flipped, atlas.overlapping], [128, 1, 0, 0]);
  [5, 2, 1, 1000 * Math.sqrt(0.125)].forEach((expected, k) => near(atlas.spreads[k].mean, expected));
  near(atlas.fill, 0.125);
  near(atlas.spreads[0].bins.reduce((sum, share) => sum + share, 0), 1);
}

async function turnedOver() {
  // The middle vertex of four cells is pulled beyond their upper right corner: both faces of that cell are turned over.
  const pulled = (x, y) => (x === 0.5 && y === 0.5 ? [0.7, 0.55] : [0.5 * x, 0.5 * y]);
  const { charts, marks, atlases: [atlas] } = await analyze(soup(square(2, flat, pulled)));
  assert.equal(charts, 1);
  const flipped = [...marks.keys()].filter((face) => marks[face] & 2);
  assert.deepEqual([flipped, atlas.flipped], [[6, 7], 2]);
  assert.ok(0 < atlas.overlapping);
}

async function overlapping() {
  // Two sheets on each other, moved by a third of a cell: neighbors that share an edge do not count.
  const shift = 1 / 3 / 4;
  const one = square(4, flat, (x, y) => [0.5 * x, 0.5 * y]);
  const other = square(4, (x, y) => [x + 3, y, 0], (x, y) => [0.5 * (x + shift), 0.5 * (y + shift)]);
  const alone = await analyze(soup(one));
  assert.equal(alone.atlases[0].overlapping, 0);
  const { atlases: [atlas], charts, marks } = await analyze(soup([...one, ...other]));
  assert.equal(charts, 2);
  assert.ok(32 < atlas.overlapping);
  assert.equal(marks.filter((mark) => mark & 1).length, 64);
}

async function tooNear() {
  // Two faces along the gap and one around its end, on each side.
  for (const [texels, expected] of [[1.9, 6], [2.1, 0]]) {
    const one = square(2, flat, (x, y) => [0.1 + 0.2 * x, 0.1 + 0.2 * y]);
    const other = square(2, (x, y) => [x + 3, y, 0], (x, y) => [0.3 + texels / 1000 + 0.2 * x, 0.1 + 0.2 * y]);
    const { atlases: [atlas] } = await analyze(soup([...one, ...other], 2));
    assert.equal(atlas.near, expected, `${texels} texels`);
  }
}

async function cut() {
  // A tube that is unrolled: one seam as long as the tube, and two rims that are none.
  const tube = (x, y) => [Math.cos(2 * Math.PI * (x % 1)), Math.sin(2 * Math.PI * (x % 1)), 3 * y];
  const { seamLength, borders, charts } = await analyze(soup(square(16, tube, (x, y) => [x, y])));
  near(seamLength, 3);
  assert.equal(charts, 1);
  const onSeam = borders.marks.filter((mark) => mark & 8).length;
  assert.deepEqual([onSeam, borders.marks.length], [32, 64]);
  assert.equal(new Set(borders.seam).size, 2);
}

async function simplified() {
  const wavy = (x, y) => [x, y, 0.1 * Math.sin(9 * x) * Math.cos(7 * y)];
  const { drawn, faces, atlases: [atlas] } = await analyze(soup(square(510, wavy, (x, y) => [x, y])));
  assert.equal(faces, 520_200);
  assert.equal(drawn.of, faces);
  // A mesh that is little larger than what is drawn loses little.
  assert.ok(400_000 < drawn.count && drawn.count <= 500_000, `${drawn.count} faces are drawn`);
  // All faces are measured, and those that are drawn stand for faces that there are.
  assert.equal(atlas.faces, faces);
  assert.ok(drawn.face.every((face) => face < faces));
}

for (const test of [stretched, turnedOver, overlapping, tooNear, cut, simplified]) {
  await test();
  console.log(test.name);
}
