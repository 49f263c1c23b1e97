// The same calls against the package `watlas` and against ours.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { unwrap } from '@gltf-transform/functions';
import * as unwrapd from 'unwrapd';
import * as watlas from 'watlas';
import { asset, CUBE, corners, io, PYRAMID } from './common.mjs';

const PACKAGES = { unwrapd, watlas };

/** An atlas of meshes. */
async function atlasOf(library, meshes, ...options) {
  await library.Initialize();
  const atlas = new library.Atlas();
  for (const mesh of meshes) atlas.addMesh(mesh);
  atlas.generate(...options);
  return atlas;
}

/** Signed areas of the triangles in UVs of which v points up. */
function areas(mesh) {
  const indices = new Uint32Array(mesh.indexCount);
  assert.equal(mesh.getIndexArray(indices), true);
  const uvs = [...indices].map((vertex) => mesh.getVertex(vertex).uv);
  return Array.from({ length: uvs.length / 3 }, (_, t) => {
    const [a, b, c] = uvs.slice(3 * t, 3 * t + 3);
    return -((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
  });
}

for (const [name, library] of Object.entries(PACKAGES)) {
  test(`${name}: what a finished atlas has`, async () => {
    const atlas = await atlasOf(library, [PYRAMID, CUBE]);
    assert.equal(atlas.meshCount, 2);
    assert.equal(atlas.atlasCount, 1);
    assert.ok(atlas.width > 0 && atlas.height > 0 && atlas.texelsPerUnit > 0);
    const utilization = new Float32Array(1);
    assert.equal(atlas.getUtilization(utilization), true);
    assert.ok(utilization[0] > 0 && utilization[0] <= 1);
    let nCharts = 0;
    for (const [i, given] of [PYRAMID, CUBE].entries()) {
      const mesh = atlas.getMesh(i);
      const indices = new Uint32Array(mesh.indexCount);
      assert.equal(mesh.indexCount, given.indexCount);
      assert.equal(mesh.getIndexArray(indices), true);
      assert.equal(mesh.getIndexArray(new Uint32Array(3)), false);
      // Triangles are the given ones, in order and with the same first corners.
      const origins = [...indices].map((vertex) => mesh.getVertex(vertex).xref);
      assert.deepEqual(origins, [...given.indexData]);
      for (let v = 0; v < mesh.vertexCount; v++) {
        const { atlasIndex, chartIndex, uv, xref } = mesh.getVertex(v);
        assert.equal(atlasIndex, 0);
        assert.ok(chartIndex >= nCharts && chartIndex < nCharts + mesh.chartCount);
        assert.ok(uv[0] >= 0 && uv[0] <= atlas.width && uv[1] >= 0 && uv[1] <= atlas.height);
        assert.ok(xref < given.vertexCount);
      }
      const faces = [];
      for (let c = 0; c < mesh.chartCount; c++) {
        const chart = mesh.getChart(c);
        const array = new Uint32Array(chart.faceCount);
        assert.equal(chart.getFaceArray(array), true);
        assert.equal(chart.atlasIndex, 0);
        assert.ok(Object.values(library.ChartType).includes(chart.type));
        faces.push(...array);
      }
      assert.deepEqual(faces.sort((a, b) => a - b), [...Array(given.indexCount / 3).keys()]);
      nCharts += mesh.chartCount;
    }
    assert.equal(atlas.chartCount, nCharts);
    assert.equal(atlas.getMesh(2), undefined);
    assert.equal(atlas.getMesh(0).getVertex(1000), undefined);
    atlas.delete();
  });

  test(`${name}: what cannot be added`, async () => {
    await library.Initialize();
    const atlas = new library.Atlas();
    const refused = (changed, pattern) => assert.throws(() => atlas.addMesh({ ...PYRAMID, ...changed }), pattern);
    refused({ indexData: new Uint16Array([0, 1, 9]), indexCount: 3 }, /IndexOutOfRange error while adding mesh/);
    refused({ indexCount: 2 }, /InvalidIndexCount error while adding mesh/);
    refused({ vertexPositionData: undefined }, TypeError);
    atlas.delete();
  });

  test(`${name}: without indices, with a stride and with an offset`, async () => {
    const positions = new Float32Array([9, 9, 9, 9, 0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0, 9]).subarray(4);
    const bare = { vertexCount: 3, vertexPositionData: positions, vertexPositionStride: 16 };
    const shifted = { ...PYRAMID, indexData: PYRAMID.indexData.map((v) => v + 5), indexOffset: -5 };
    const atlas = await atlasOf(library, [bare, shifted]);
    assert.equal(atlas.getMesh(0).indexCount, 3);
    assert.ok(Math.abs(areas(atlas.getMesh(0))[0]) > 0);
    const indices = new Uint32Array(12);
    atlas.getMesh(1).getIndexArray(indices);
    assert.deepEqual([...indices].map((v) => atlas.getMesh(1).getVertex(v).xref), [...PYRAMID.indexData]);
  });

  test(`${name}: an empty atlas`, async () => {
    const atlas = await atlasOf(library, []);
    assert.deepEqual([atlas.meshCount, atlas.chartCount, atlas.width, atlas.height], [0, 0, 0, 0]);
  });

  test(`${name}: islands are packed`, async () => {
    await library.Initialize();
    const atlas = new library.Atlas();
    const vertexUvData = new Float32Array([0, 0, 1, 0, 0, 1, 5, 5, 6, 5, 5, 6]);
    const indexData = new Uint16Array([0, 1, 2, 3, 4, 5]);
    atlas.addUvMesh({ vertexUvData, vertexCount: 6, vertexStride: 8, indexData, indexCount: 6 });
    atlas.generate({}, { resolution: 256 });
    assert.equal(atlas.chartCount, 2);
    assert.equal(atlas.getMesh(0).vertexCount, 6);
    // Both triangles keep their size and winding.
    const [first, second] = areas(atlas.getMesh(0));
    assert.ok(Math.abs(first / second - 1) < 0.05, `${first} ${second}`);
  });

  test(`${name}: glTF-Transform's unwrap`, async () => {
    const document = await io.read(asset('SimpleMorph.gltf'));
    const [mesh] = document.getRoot().listMeshes();
    const [primitive] = mesh.listPrimitives();
    const positions = corners(primitive, 'POSITION');
    await document.transform(unwrap({ watlas: library, texcoord: 0, overwrite: true, groupBy: 'scene' }));
    assert.deepEqual(corners(primitive, 'POSITION'), positions);
    const uvs = corners(primitive, 'TEXCOORD_0');
    assert.ok(uvs.flat().every((x) => x >= 0 && x <= 1));
    assert.equal(uvs.length, positions.length);
  });
}

test('no triangle is mirrored, and there are fewer charts', async () => {
  const ours = await atlasOf(unwrapd, [CUBE]);
  assert.ok(areas(ours.getMesh(0)).every((area) => area > 0));
  assert.ok(ours.chartCount < (await atlasOf(watlas, [CUBE])).chartCount);
});

test('UVs that glTF-Transform writes are exact', async () => {
  const atlas = await atlasOf(unwrapd.withOptions({ resolution: 1000 }), [CUBE]);
  const mesh = atlas.getMesh(0);
  assert.deepEqual([atlas.width, atlas.height], [1000, 1000]);
  for (let v = 0; v < mesh.vertexCount; v++) {
    for (const texels of mesh.getVertex(v).uv) {
      const written = Math.fround(texels * (1 / 1000));
      assert.equal(written * 2 ** 23, Math.round(written * 2 ** 23));
    }
  }
});

test('triangles that are not finite have no place', async () => {
  const vertexPositionData = Float32Array.from(PYRAMID.vertexPositionData, (x, i) => (i === 0 ? NaN : x));
  const atlas = await atlasOf(unwrapd, [{ ...PYRAMID, vertexPositionData }]);
  const mesh = atlas.getMesh(0);
  const indices = new Uint32Array(12);
  mesh.getIndexArray(indices);
  assert.deepEqual([...indices].map((v) => mesh.getVertex(v).xref), [...PYRAMID.indexData]);
  const [first] = indices;
  assert.deepEqual(mesh.getVertex(first), { atlasIndex: -1, chartIndex: -1, uv: [0, 0], xref: 0 });
  assert.equal(areas(mesh).filter((area) => area > 0).length, 2);
});

test('options are honored or named', async () => {
  const warnings = [];
  const hear = (warning) => warnings.push(warning.message);
  process.on('warning', hear);
  const atlas = await atlasOf(unwrapd, [CUBE], { maxCost: 3, fixWinding: true }, { resolution: 64, padding: 3 });
  await new Promise(setImmediate);
  process.off('warning', hear);
  assert.deepEqual(warnings, ['unwrapd: ChartOptions.maxCost has no effect']);
  assert.equal(atlas.width, 64);
  const dense = await atlasOf(unwrapd, [CUBE], {}, { texelsPerUnit: 100 });
  assert.ok(Math.abs(dense.texelsPerUnit - 100) < 1e-3, `${dense.texelsPerUnit}`);
  const pages = await atlasOf(unwrapd, [CUBE], {}, { texelsPerUnit: 100, resolution: 128 });
  assert.ok(pages.atlasCount > 1);
  const found = new Set();
  for (let v = 0; v < pages.getMesh(0).vertexCount; v++) found.add(pages.getMesh(0).getVertex(v).atlasIndex);
  assert.equal(found.size, pages.atlasCount);
});

test('hard edges are cut where that is asked for', async () => {
  const smooth = Float32Array.from(CUBE.vertexPositionData, (x) => x - 0.5);
  const given = { ...CUBE, vertexNormalData: smooth, vertexNormalStride: 12 };
  const flat = { ...PYRAMID, vertexNormalData: PYRAMID.vertexPositionData, vertexNormalStride: 12 };
  const atlas = await atlasOf(unwrapd, [given, flat], { normalSeamWeight: 2000 });
  assert.equal(atlas.getMesh(1).chartCount, 1);
});

test('errors have the codes of the service', async () => {
  await assert.rejects(atlasOf(unwrapd.withOptions({ seamWieght: 1 }), [CUBE]), (error) => {
    assert.ok(error instanceof unwrapd.InvalidOptions && error instanceof unwrapd.UnwrapdError);
    assert.match(error.message, /seamWieght/);
    assert.deepEqual([error.name, error.code, error.exitCode], ['InvalidOptions', 'invalid_options', 2]);
    return true;
  });
});
