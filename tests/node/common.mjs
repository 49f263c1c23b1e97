// Meshes and documents that several tests work on.

import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { Document, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';

/** A pyramid without its base: one chart. */
export const PYRAMID = {
  vertexCount: 5,
  vertexPositionData: new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0.7]),
  vertexPositionStride: 12,
  indexData: new Uint16Array([0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4]),
  indexCount: 12,
};

/** A closed cube. */
export const CUBE = {
  vertexCount: 8,
  vertexPositionData: new Float32Array([0, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 1, 0, 0, 1, 0, 1, 1, 1, 0, 1, 1, 1]),
  vertexPositionStride: 12,
  indexData: new Uint32Array([
    0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3,
  ]),
  indexCount: 36,
};

/** A file of the repository's tests. */
export function asset(name) {
  return join(process.env.UNWRAPD_REPOSITORY, 'tests/assets', name);
}

export function assetBytes(name) {
  return readFile(asset(name));
}

export const io = new NodeIO().registerExtensions(ALL_EXTENSIONS);

/** A bent sheet of side² vertices as a document. */
export function sheet(side) {
  const document = new Document();
  const buffer = document.createBuffer();
  const positions = [];
  const indices = [];
  for (let i = 0; i < side * side; i++) {
    const [x, y] = [(i % side) / (side - 1), Math.floor(i / side) / (side - 1)];
    positions.push(x, y, 0.3 * Math.sin(9 * x) * Math.cos(7 * y));
    if (i % side < side - 1 && i < side * (side - 1)) indices.push(i, i + 1, i + side, i + 1, i + side + 1, i + side);
  }
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const primitive = document
    .createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', new Float32Array(positions)))
    .setIndices(accessor('SCALAR', new Uint32Array(indices)));
  document.createScene().addChild(document.createNode().setMesh(document.createMesh().addPrimitive(primitive)));
  return document;
}

/** For each corner of each triangle of a primitive what an attribute has. */
export function corners(primitive, semantic) {
  const attribute = primitive.getAttribute(semantic);
  const order = primitive.getIndices()?.getArray() ?? [...Array(attribute.getCount()).keys()];
  return [...order].map((vertex) => attribute.getElement(vertex, []));
}
