// Faces of one atlas that overlap.

import { meetingBoxes } from "./grid";
import type { Faces } from "./soup";

/** Tolerance for rounding, relative to the size of the faces. */
const TOLERANCE = 1e-9;

/** Calls back with each pair of these faces that overlap, and returns their number. Ignores faces without UVs. */
export function overlapsOf(faces: Pick<Faces, "uvs">, all: Uint32Array, found: (one: number, other: number) => void): number {
  const members = all.filter((face) => hasUvs(faces, face));
  const boxes = new Float64Array(4 * members.length);
  let sizes = 0;
  members.forEach((face, k) => {
    boxOf(faces.uvs, face, boxes, 4 * k);
    sizes += Math.max(boxes[4 * k + 2]! - boxes[4 * k]!, boxes[4 * k + 3]! - boxes[4 * k + 1]!);
  });
  const cell = Math.max((2 * sizes) / Math.max(members.length, 1), 1e-6);
  let pairs = 0;
  meetingBoxes(boxes, cell, (one, other) => {
    const [a, b] = [members[one]!, members[other]!];
    if (isApart(faces.uvs, a, b) || isApart(faces.uvs, b, a)) return;
    pairs += 1;
    found(a, b);
  });
  return pairs;
}

/** Returns whether all corners of a face have UVs that are numbers. */
export function hasUvs({ uvs }: Pick<Faces, "uvs">, face: number): boolean {
  for (let i = 6 * face; i < 6 * face + 6; i++) if (!Number.isFinite(uvs[i]!)) return false;
  return true;
}

function boxOf(uvs: Float32Array, face: number, boxes: Float64Array, at: number): void {
  const i = 6 * face;
  for (let axis = 0; axis < 2; axis++) {
    const [a, b, c] = [uvs[i + axis]!, uvs[i + axis + 2]!, uvs[i + axis + 4]!];
    boxes[at + axis] = Math.min(a, b, c);
    boxes[at + axis + 2] = Math.max(a, b, c);
  }
}

/** Returns whether a line along a side of `one` separates the two faces. */
function isApart(uvs: Float32Array, one: number, other: number): boolean {
  const [a, b] = [6 * one, 6 * other];
  for (let k = 0; k < 6; k += 2) {
    const [i, j, l] = [a + k, a + ((k + 2) % 6), a + ((k + 4) % 6)];
    const own = side(uvs, i, j, l);
    if (own === 0) return true;
    const sign = Math.sign(own);
    const farthest = Math.max(sign * side(uvs, i, j, b), sign * side(uvs, i, j, b + 2), sign * side(uvs, i, j, b + 4));
    if (farthest <= TOLERANCE * ((uvs[j]! - uvs[i]!) ** 2 + (uvs[j + 1]! - uvs[i + 1]!) ** 2)) return true;
  }
  return false;
}

/** Returns the side of the line from corner i to corner j on which a corner lies. */
function side(uvs: Float32Array, i: number, j: number, corner: number): number {
  const [u, v] = [uvs[i]!, uvs[i + 1]!];
  return (uvs[j]! - u) * (uvs[corner + 1]! - v) - (uvs[j + 1]! - v) * (uvs[corner]! - u);
}
