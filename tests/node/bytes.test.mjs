// Files in memory.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { InvalidInput, InvalidOptions, unwrapBytes } from 'unwrapd';
import { assetBytes, io, sheet } from './common.mjs';

test('a file is unwrapped and certified', async () => {
  const { bytes, others, report } = await unwrapBytes(await assetBytes('Box.glb'));
  const document = await io.readBinary(bytes);
  const [primitive] = document.getRoot().listMeshes()[0].listPrimitives();
  assert.ok(primitive.getAttribute('TEXCOORD_0'));
  assert.deepEqual(others, []);
  assert.equal(report.certified, true);
});

test('several files', async () => {
  const { others } = await unwrapBytes(await assetBytes('Box.glb'), { format: 'gltf' });
  assert.equal(others.length, 1);
});

test('the main thread is free meanwhile', async () => {
  let turns = 0;
  const timer = setInterval(() => turns++, 5);
  await unwrapBytes(await io.writeBinary(sheet(60)));
  clearInterval(timer);
  assert.ok(turns > 3, `${turns}`);
});

test('progress is told', async () => {
  const told = [];
  await unwrapBytes(await io.writeBinary(sheet(120)), { onProgress: (progress) => told.push(progress) });
  assert.ok(told.length > 0);
  const fractions = told.map(({ fraction }) => fraction);
  assert.deepEqual(fractions, fractions.toSorted((a, b) => a - b));
  assert.ok(told.every(({ stage, chart, charts }) => typeof stage === 'string' && 0 <= chart && 0 <= charts));
});

test('a signal ends the work', async () => {
  const bytes = await io.writeBinary(sheet(200));
  const controller = new AbortController();
  const work = unwrapBytes(bytes, { signal: controller.signal });
  await new Promise((resolve) => setTimeout(resolve, 100));
  const begin = performance.now();
  controller.abort();
  await assert.rejects(work, { name: 'AbortError' });
  assert.ok(performance.now() - begin < 1000, `${performance.now() - begin} ms`);
  const early = unwrapBytes(bytes, { signal: AbortSignal.abort(new Error('before')) });
  await assert.rejects(early, /before/);
});

test('errors have the codes of the service', async () => {
  const box = await assetBytes('Box.glb');
  const refused = async (work, kind, code) => {
    await assert.rejects(work, (error) => {
      assert.ok(error instanceof kind, `${error}`);
      assert.equal(error.code, code);
      return true;
    });
  };
  await refused(unwrapBytes(box, { padding: -1 }), InvalidOptions, 'invalid_options');
  await refused(unwrapBytes(box, { colour: 'red' }), InvalidOptions, 'invalid_options');
  await refused(unwrapBytes(new TextEncoder().encode('v 0 0 0\n'), { name: 'm.obj' }), InvalidInput, 'no_triangles');
  await assert.rejects(unwrapBytes(box.subarray(0, 100)), InvalidInput);
});

test('bytes may be any buffer, and nothing else', async () => {
  const box = await assetBytes('Box.glb');
  const buffer = box.buffer.slice(box.byteOffset, box.byteOffset + box.byteLength);
  const { report } = await unwrapBytes(buffer, null);
  assert.equal(report.certified, true);
  await assert.rejects(unwrapBytes('Box.glb'), (error) => error instanceof InvalidInput && /fs\.readFile/.test(error.message));
  await assert.rejects(unwrapBytes(), (error) => error instanceof InvalidInput && /not undefined/.test(error.message));
  await assert.rejects(unwrapBytes(buffer, 'fast'), InvalidOptions);
});

test('an unknown option is told the nearest, in camel case', async () => {
  const box = await assetBytes('Box.glb');
  for (const options of [{ max_charts: 3 }, { maxChart: 3 }]) {
    await assert.rejects(
      unwrapBytes(box, options),
      (error) => error instanceof InvalidOptions && error.message.includes("did you mean 'maxCharts'?"),
    );
  }
});
