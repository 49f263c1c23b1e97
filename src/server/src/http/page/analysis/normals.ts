// Normals for shading files without normals: smooth except over creases.

import { bits, firstEqual } from "./weld";

/** Cosine of the angle above which faces are not smoothed: 45°. */
const CREASE = Math.cos(Math.PI / 4);

/** Returns the normals of corners, from -127 to 127, four numbers per corner. */
export function packedNormals(positions: Float32Array, given: Float32Array | null): Int8Array {
  const corners = positions.length / 3;
  const packed = new Int8Array(4 * corners);
  const normals = given ?? smoothNormals(positions);
  for (let i = 0; i < corners; i++) {
    const [x, y, z] = [normals[3 * i]!, normals[3 * i + 1]!, normals[3 * i + 2]!];
    const scale = 127 / (Math.hypot(x, y, z) || 1);
    packed[4 * i] = Math.round(x * scale);
    packed[4 * i + 1] = Math.round(y * scale);
    packed[4 * i + 2] = Math.round(z * scale);
  }
  return packed;
}

function smoothNormals(positions: Float32Array): Float32Array {
  const corners = positions.length / 3;
  const own = faceNormals(positions);
  const place = firstEqual(bits(positions), corners);
  const sums = new Float32Array(3 * corners);
  for (let i = 0; i < corners; i++) {
    const face = Math.floor(i / 3);
    for (let k = 0; k < 3; k++) sums[3 * place[i]! + k]! += own[3 * face + k]!;
  }
  const normals = new Float32Array(3 * corners);
  for (let i = 0; i < corners; i++) {
    const [face, at] = [3 * Math.floor(i / 3), 3 * place[i]!];
    const dot = own[face]! * sums[at]! + own[face + 1]! * sums[at + 1]! + own[face + 2]! * sums[at + 2]!;
    const lengths = Math.hypot(own[face]!, own[face + 1]!, own[face + 2]!) * Math.hypot(sums[at]!, sums[at + 1]!, sums[at + 2]!);
    const from = CREASE * lengths <= dot ? sums.subarray(at, at + 3) : own.subarray(face, face + 3);
    normals.set(from, 3 * i);
  }
  return normals;
}

/** Returns the normals of faces, with twice their area as length. */
function faceNormals(p: Float32Array): Float32Array {
  const normals = new Float32Array(p.length / 3);
  for (let i = 0, n = 0; i < p.length; i += 9, n += 3) {
    const [ax, ay, az] = [p[i + 3]! - p[i]!, p[i + 4]! - p[i + 1]!, p[i + 5]! - p[i + 2]!];
    const [bx, by, bz] = [p[i + 6]! - p[i]!, p[i + 7]! - p[i + 1]!, p[i + 8]! - p[i + 2]!];
    normals[n] = ay * bz - az * by;
    normals[n + 1] = az * bx - ax * bz;
    normals[n + 2] = ax * by - ay * bx;
  }
  return normals;
}
