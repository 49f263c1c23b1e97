// The transform: what it changes of a document, and that it changes nothing else.

import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { test } from 'node:test';
import { Document, Logger } from '@gltf-transform/core';
import { KHRDracoMeshCompression, KHRMaterialsClearcoat } from '@gltf-transform/extensions';
import { InvalidOptions, unwrapBytes, unwrapd } from 'unwrapd';
import { asset, corners, io, sheet } from './common.mjs';

const ASSETS = ['Box.glb', 'MultiUVTest.glb', 'SimpleMorph.gltf', 'SimpleSkin.gltf'];

async function unwrapped(document, options = {}) {
  let report;
  document.setLogger(new Logger(Logger.Verbosity.ERROR));
  await document.transform(unwrapd({ ...options, onReport: (found) => (report = found) }));
  return report;
}

const primitivesOf = (document) => document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives());

for (const name of ASSETS) {
  test(`${name}: all else stays`, async () => {
    const document = await io.read(asset(name));
    const root = document.getRoot();
    const identity = [...root.listNodes(), ...root.listMeshes(), ...root.listMaterials(), ...root.listTextures()];
    const before = primitivesOf(document).map((primitive) => ({
      primitive,
      attributes: new Map(primitive.listSemantics().map((semantic) => [semantic, corners(primitive, semantic)])),
      targets: primitive.listTargets().length,
      material: primitive.getMaterial(),
    }));
    const report = await unwrapped(document, { texcoord: 3 });
    assert.equal(report.certified, true);
    assert.deepEqual(
      [...root.listNodes(), ...root.listMeshes(), ...root.listMaterials(), ...root.listTextures()],
      identity,
    );
    for (const { primitive, attributes, targets, material } of before) {
      for (const [semantic, values] of attributes) assert.deepEqual(corners(primitive, semantic), values, semantic);
      assert.equal(primitive.listTargets().length, targets);
      assert.equal(primitive.getMaterial(), material);
      assert.ok(primitive.getAttribute('TEXCOORD_3'));
    }
    // Nothing is left over, and what is written is what the library wrote.
    for (const accessor of root.listAccessors()) assert.ok(accessor.listParents().length > 1);
    const again = primitivesOf(await io.readJSON(await io.writeJSON(document)));
    for (const [i, primitive] of primitivesOf(document).entries()) {
      assert.deepEqual(corners(again[i], 'TEXCOORD_3'), corners(primitive, 'TEXCOORD_3'));
    }
  });
}

test('UVs are those of the library', async () => {
  const direct = await unwrapBytes(await io.writeBinary(sheet(20)), { quality: 'smooth' });
  const document = sheet(20);
  await unwrapped(document, { quality: 'smooth' });
  const [expected] = primitivesOf(await io.readBinary(direct.bytes));
  assert.deepEqual(corners(primitivesOf(document)[0], 'TEXCOORD_0'), corners(expected, 'TEXCOORD_0'));
});

test('morph targets go along', async () => {
  const document = await io.read(asset('SimpleMorph.gltf'));
  const [primitive] = primitivesOf(document);
  const values = () => primitive.listTargets().map((target) => corners(withIndices(target), 'POSITION'));
  const withIndices = (target) => ({
    getAttribute: (semantic) => target.getAttribute(semantic),
    getIndices: () => primitive.getIndices(),
  });
  const before = values();
  await unwrapped(document);
  assert.deepEqual(values(), before);
});

test('extensions, several buffers and textures', async () => {
  const document = sheet(8);
  const [primitive] = primitivesOf(document);
  const clearcoat = document.createExtension(KHRMaterialsClearcoat).createClearcoat().setClearcoatFactor(0.5);
  const texture = document.createTexture('t').setImage(new Uint8Array([1, 2, 3])).setMimeType('image/png');
  texture.setURI('an image.png');
  const material = document.createMaterial().setExtension('KHR_materials_clearcoat', clearcoat);
  primitive.setMaterial(material.setEmissiveTexture(texture)).setExtras({ kept: true });
  document.createExtension(KHRDracoMeshCompression).setRequired(true);
  document.createAccessor().setType('SCALAR').setArray(new Float32Array(3)).setBuffer(document.createBuffer('other'));
  const report = await unwrapped(document, { texcoord: 0, overwrite: true });
  assert.equal(report.certified, true);
  assert.equal(primitive.getMaterial().getExtension('KHR_materials_clearcoat'), clearcoat);
  assert.deepEqual([...texture.getImage()], [1, 2, 3]);
  assert.deepEqual(primitive.getExtras(), { kept: true });
  assert.equal(document.getRoot().listBuffers().length, 2);
  assert.equal(document.getRoot().listExtensionsRequired().length, 1);
});

test('what is shared stays shared', async () => {
  const document = sheet(8);
  const [first] = primitivesOf(document);
  document.getRoot().listMeshes()[0].addPrimitive(first.clone());
  const other = document.createMesh().addPrimitive(first.clone());
  document.getRoot().listNodes()[0].addChild(document.createNode().setMesh(other));
  await unwrapped(document, { groupBy: 'primitive' });
  for (const primitive of primitivesOf(document)) assert.ok(primitive.getAttribute('TEXCOORD_0'));
  for (const accessor of document.getRoot().listAccessors()) assert.ok(accessor.listParents().length > 1);
});

test('a document of the copy for require', async () => {
  const core = createRequire(import.meta.url)('@gltf-transform/core');
  const document = await new core.NodeIO().read(asset('Box.glb'));
  assert.ok(!(document instanceof Document));
  assert.equal((await unwrapped(document)).certified, true);
  assert.ok(primitivesOf(document)[0].getAttribute('TEXCOORD_0'));
  await assert.rejects(unwrapped({ transform: (apply) => apply({}), setLogger() {} }), { code: 'invalid_document' });
});

test('an empty document is refused, as the library refuses it', async () => {
  await assert.rejects(unwrapped(new Document()), { code: 'no_triangles' });
});

test('what would change more than meshes is refused', () => {
  assert.throws(() => unwrapd({ rebake: true }), InvalidOptions);
});

test('a signal ends the work', async () => {
  const signal = AbortSignal.timeout(50);
  await assert.rejects(unwrapped(sheet(200), { signal }), { name: 'TimeoutError' });
});
