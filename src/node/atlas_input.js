// Meshes as the package `watlas` takes them, with its errors.

import { InvalidInput } from './errors.js';

const refuse = (what, code) => {
  throw new InvalidInput(`${what} error while adding mesh`, code, 3);
};

/** A mesh that was added: triangles with a position that is not finite take no part. */
class Input {
  constructor({ positions, indices, uvs, normals, isFlat }) {
    Object.assign(this, { positions, indices, uvs, normals, isFlat });
    const isFinite = (v) => [0, 1, 2].every((k) => Number.isFinite(positions[3 * v + k]));
    const all = Array.from({ length: indices.length / 3 }, (_, t) => t);
    /** The triangles that take part. */
    this.triangles = all.filter((t) => this.corners(t).every(isFinite));
  }

  corners(triangle) {
    return [0, 1, 2].map((c) => this.indices[3 * triangle + c]);
  }

  /** Of what takes part. */
  area() {
    const at = (v) => [0, 1, 2].map((k) => this.positions[3 * v + k]);
    return this.triangles.reduce((sum, triangle) => {
      const [a, b, c] = this.corners(triangle).map(at);
      const [d, e] = [b, c].map((p) => p.map((x, k) => x - a[k]));
      const normal = [0, 1, 2].map((k) => d[(k + 1) % 3] * e[(k + 2) % 3] - d[(k + 2) % 3] * e[(k + 1) % 3]);
      return sum + Math.hypot(...normal) / 2;
    }, 0);
  }

  /** What takes part, for the library, in which v points up. */
  arrays({ withUvs, withNormals }) {
    const indices = Uint32Array.from(this.triangles.flatMap((triangle) => this.corners(triangle)));
    const uvs = withUvs ? this.uvs?.map((x, i) => (i % 2 === 1 ? -x : x)) : undefined;
    const normals = withNormals ? this.normals : undefined;
    return { positions: this.positions, indices, uvs, normals };
  }
}

/** A mesh from the argument of `addMesh`. */
export function taken(decl) {
  const { vertexCount, vertexPositionData, vertexNormalData, vertexUvData } = decl;
  const positions = rows('vertexPositionData', vertexPositionData, vertexCount, decl.vertexPositionStride, 3);
  const normals =
    vertexNormalData && rows('vertexNormalData', vertexNormalData, vertexCount, decl.vertexNormalStride, 3);
  const uvs = vertexUvData && rows('vertexUvData', vertexUvData, vertexCount, decl.vertexUvStride, 2);
  return new Input({ positions, indices: indicesOf(decl), uvs, normals, isFlat: false });
}

/** A flat mesh from the argument of `addUvMesh`. */
export function takenUvs(decl) {
  const { vertexCount, vertexUvData, vertexStride } = decl;
  const uvs = rows('vertexUvData', vertexUvData, vertexCount, vertexStride, 2);
  const positions = new Float32Array(3 * vertexCount);
  for (let v = 0; v < vertexCount; v++) positions.set([uvs[2 * v], -uvs[2 * v + 1]], 3 * v);
  return new Input({ positions, indices: indicesOf(decl), uvs, isFlat: true });
}

/** The first numbers of each row of a table whose rows lie a stride of bytes apart. */
function rows(name, data, count, stride, width) {
  if (!(data instanceof Float32Array)) throw new TypeError(`"${name}" must be a Float32Array`);
  if (!Number.isInteger(count) || count < 0) throw new TypeError('"vertexCount" must be a whole number');
  const step = (stride || width * data.BYTES_PER_ELEMENT) / data.BYTES_PER_ELEMENT;
  if (!Number.isInteger(step) || step < width) throw new TypeError(`the stride of "${name}" must be whole rows`);
  if (count > 0 && (count - 1) * step + width > data.length) refuse('IndexOutOfRange', 'index_out_of_range');
  const found = new Float32Array(count * width);
  for (let row = 0; row < count; row++) found.set(data.subarray(row * step, row * step + width), row * width);
  return found;
}

/** The vertices of the triangles; without indices they are in order. */
function indicesOf({ vertexCount, indexData, indexCount, indexOffset = 0, faceVertexCount }) {
  if (faceVertexCount?.some((count) => count !== 3)) refuse('InvalidFaceVertexCount', 'invalid_mesh');
  const given = indexData ? indexData.subarray(0, indexCount ?? indexData.length) : undefined;
  const indices = given
    ? Uint32Array.from(given, (index) => index + indexOffset)
    : Uint32Array.from({ length: indexCount || vertexCount }, (_, v) => v);
  if (indices.length === 0 || indices.length % 3 !== 0) refuse('InvalidIndexCount', 'invalid_mesh');
  if (indices.some((v) => v >= vertexCount)) refuse('IndexOutOfRange', 'index_out_of_range');
  return indices;
}
