// The islands of pulled UVs, from the connectivity of their triangles alone, and their defects.

import type { Charts } from "../analysis/charts";
import { nearBorders } from "../analysis/gaps";
import { overlapsOf } from "../analysis/overlaps";
import type { Texture } from "../analysis/soup";

/** Defects of UVs that are pulled. */
export interface Faults {
  /** Number of pairs of faces that overlap. */
  pairs: number;
  /** Number of faces beyond the pages that contained all faces at rest. */
  beyond: number;
  /** Number of borders that are nearer than the padding to another island. */
  near: number;
}

/** The faces and borders to mark. */
export interface Marked {
  faces: Set<number>;
  /** Indices of borders: 3f + k for edge k of face f. */
  borders: number[];
}

/** Share of the page below which a distance from its border is rounding. */
const TOLERANCE = 1e-6;

/** Triangles of a UV map: corners share a vertex only within an island. */
export class Islands {
  readonly #count: number;
  readonly #charts: Pick<Charts, "borders" | "ofFace">;
  readonly #pages: number;

  constructor(readonly triangles: Uint32Array, atRest: Float32Array) {
    this.#count = triangles.length / 3;
    this.#charts = { borders: bordersOf(triangles), ofFace: islandsOf(triangles) };
    this.#pages = atRest.reduce((most, u, k) => (k % 2 ? most : Math.max(most, Math.ceil(u - TOLERANCE))), 1);
  }

  /** Finds the defects of UVs, six numbers per face. Without a texture, gaps are not judged. */
  judge(uvs: Float32Array, texture: Texture | null): { faults: Faults; marked: Marked } {
    const faces = new Set<number>();
    const all = Uint32Array.from({ length: this.#count }, (_, k) => k);
    const pairs = overlapsOf({ uvs }, all, (one, other) => faces.add(one).add(other));
    const beyond = all.filter((face) => this.#isBeyond(uvs, face));
    for (const face of beyond) faces.add(face);
    const group = new Uint16Array(this.#count);
    const near = texture ? nearBorders({ uvs, group }, this.#charts, texture) : new Uint8Array();
    const borders = [...this.#charts.borders].filter((_, k) => near[k]);
    return { faults: { pairs, beyond: beyond.length, near: borders.length }, marked: { faces, borders } };
  }

  #isBeyond(uvs: Float32Array, face: number): boolean {
    return uvs.subarray(6 * face, 6 * face + 6).some((x, k) => x < -TOLERANCE || (k % 2 ? 1 : this.#pages) + TOLERANCE < x);
  }
}

/** Returns the edges that belong to one triangle only. */
function bordersOf(triangles: Uint32Array): Uint32Array {
  const first = new Map<number, number>();
  const borders = new Set<number>();
  for (let edge = 0; edge < triangles.length; edge++) {
    const [a, b] = [triangles[edge]!, triangles[edge % 3 === 2 ? edge - 2 : edge + 1]!];
    const key = Math.min(a, b) * 0x4000000 + Math.max(a, b);
    const other = first.get(key);
    if (other === undefined) borders.add(edge);
    else borders.delete(other);
    first.set(key, other ?? edge);
  }
  return Uint32Array.from(borders);
}

/** Returns a number for each triangle, equal for those that are connected by vertices. */
function islandsOf(triangles: Uint32Array): Uint32Array {
  const parent = Uint32Array.from({ length: triangles.reduce((most, v) => Math.max(most, v + 1), 0) }, (_, v) => v);
  const root = (v: number) => {
    while (parent[v] !== v) v = parent[v] = parent[parent[v]!]!;
    return v;
  };
  for (let k = 0; k < triangles.length; k += 3) {
    const to = root(triangles[k]!);
    parent[root(triangles[k + 1]!)] = to;
    parent[root(triangles[k + 2]!)] = to;
  }
  return Uint32Array.from({ length: triangles.length / 3 }, (_, face) => root(triangles[3 * face]!));
}
