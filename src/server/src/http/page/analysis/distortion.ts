// Deviation of the map of each face from an isometry.

import type { Faces, Texture } from "./soup";

/** Measures that a heat map can show, in the order of `Distortion.values`. */
export const MEASURES = ["sym-dirichlet", "angle", "area", "density"] as const;
export type Measure = (typeof MEASURES)[number];

/** Returns how much a face with this value is stretched, as a share: lengths for the symmetric Dirichlet energy (those of a map
 * with singular values s, s or s, 1/s, which have that energy), the ratio of its axes for angles, and areas for areas.
 * 0 is an isometry, 1 is stretched or compressed to double or half. */
export function stretchOf(measure: Measure, value: number): number {
  if (measure !== "sym-dirichlet") return value - 1;
  const q = Math.max(value / 4, 1);
  return Math.sqrt(q + Math.sqrt(q * q - 1)) - 1;
}

/** Measures of faces. */
export interface Distortion {
  /** Four numbers per face: σ₁² + σ₂² + σ₁⁻² + σ₂⁻², least 4; σ₁/σ₂, least 1; max(σ₁σ₂, 1/σ₁σ₂), least 1; texels per
   * unit of length. NaN for faces without area. The first three do not depend on the scale of a group's UVs. */
  values: Float32Array;
  /** Area on the surface of each face. */
  area: Float64Array;
  /** Area in the plane of each face, in texels, negative if it is clockwise with v up. */
  texels: Float64Array;
}

/** Measures all faces. */
export function distortionOf(faces: Faces, texture: Texture): Distortion {
  const n = faces.count;
  const area = new Float64Array(n);
  const texels = new Float64Array(n);
  const values = new Float32Array(4 * n).fill(Number.NaN);
  const maps = new Float64Array(2 * n);
  for (let face = 0; face < n; face++) {
    const map = jacobian(faces, face, texture);
    area[face] = map.area;
    texels[face] = map.area * map.determinant || 0;
    maps[2 * face] = map.squares;
    maps[2 * face + 1] = map.determinant;
  }
  const scale = scales(faces, area, texels);
  for (let face = 0; face < n; face++) {
    const s = scale[faces.group[face]!]!;
    const [squares, determinant] = [maps[2 * face]! / s, Math.abs(maps[2 * face + 1]!) / s];
    if (!(0 < determinant) || !(0 < area[face]!)) continue;
    const root = (sign: number) => Math.sqrt(Math.max(squares + sign * 2 * determinant, 0));
    values[4 * face] = squares + squares / determinant ** 2;
    values[4 * face + 1] = (root(1) + root(-1)) ** 2 / (4 * determinant);
    values[4 * face + 2] = Math.max(determinant, 1 / determinant);
    values[4 * face + 3] = Math.sqrt(determinant * s);
  }
  return { values, area, texels };
}

/** Returns figures of the map from the surface to texels: area of the face, σ₁² + σ₂², and ±σ₁σ₂. */
function jacobian(faces: Faces, face: number, { width, height }: Texture) {
  const p = faces.positions;
  const at = 9 * face;
  const [ax, ay, az] = [p[at + 3]! - p[at]!, p[at + 4]! - p[at + 1]!, p[at + 5]! - p[at + 2]!];
  const [bx, by, bz] = [p[at + 6]! - p[at]!, p[at + 7]! - p[at + 1]!, p[at + 8]! - p[at + 2]!];
  const doubled = Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx);
  const long = Math.hypot(ax, ay, az);
  const along = (ax * bx + ay * by + az * bz) / long;
  const high = doubled / long;
  const uv = faces.uvs;
  const i = 6 * face;
  const [au, av] = [(uv[i + 2]! - uv[i]!) * width, (uv[i + 3]! - uv[i + 1]!) * height];
  const [bu, bv] = [(uv[i + 4]! - uv[i]!) * width, (uv[i + 5]! - uv[i + 1]!) * height];
  const [xu, xv] = [au / long, av / long];
  const [yu, yv] = [(bu - xu * along) / high, (bv - xv * along) / high];
  return { area: doubled / 2, squares: xu * xu + xv * xv + yu * yu + yv * yv, determinant: xu * yv - xv * yu };
}

/** Returns the mean texels per unit of area of each group, with which its faces are compared. */
function scales(faces: Faces, area: Float64Array, texels: Float64Array): number[] {
  const surface: number[] = [];
  const plane: number[] = [];
  for (let face = 0; face < faces.count; face++) {
    if (!(0 < area[face]!) || !texels[face]) continue;
    const g = faces.group[face]!;
    surface[g] = (surface[g] ?? 0) + area[face]!;
    plane[g] = (plane[g] ?? 0) + Math.abs(texels[face]!);
  }
  return surface.map((sum, g) => plane[g]! / sum);
}

/** Marks flipped faces: those oriented against most of their chart's area. */
export function flippedFaces(faces: Faces, chart: Uint32Array, texels: Float64Array): Uint8Array {
  const balance = new Map<number, number>();
  const key = (face: number) => chart[face]! * 65536 + faces.group[face]!;
  for (let face = 0; face < faces.count; face++) {
    balance.set(key(face), (balance.get(key(face)) ?? 0) + texels[face]!);
  }
  const flipped = new Uint8Array(faces.count);
  for (let face = 0; face < faces.count; face++) {
    if (texels[face]! * balance.get(key(face))! < 0) flipped[face] = 1;
  }
  return flipped;
}
