// Charts, and the seams between them: faces belong together where they share an edge on the surface and in the plane.

import { hasUvs } from "./overlaps";
import type { Faces } from "./soup";
import { bits, type Edges, edgesOf, firstEqual, next } from "./weld";

/** Connectivity of faces. */
export interface Charts {
  count: number;
  /** The chart of each face, counted within its group from 0 in the order of faces; faces without UVs are numbered after all charts. */
  ofFace: Uint32Array;
  /** Number of charts of each group; faces without UVs form none. */
  ofGroup: number[];
  /** The first corner at the same place of the same mesh, for each corner. */
  place: Uint32Array;
  /** Edges that end a chart: 3f + k for edge k of face f, ascending. */
  borders: Uint32Array;
  /** For each of `borders`, 1 if another face lies on the other side on the surface: a seam. */
  isSeam: Uint8Array;
  /** For each of `borders`, its seam: all edges between the same two charts, or the rest of a chart's border, which
   * has no other side. */
  seam: Uint32Array;
}

/** Finds the charts of faces. */
export function chartsOf(faces: Faces): Charts {
  const place = placesOf(faces);
  const inPlane = edgesOf(wedgesOf(faces, place));
  const root = joined(faces.count, inPlane);
  const numbers = numbered(root, faces);
  const onSurface = edgesOf(place);
  const borders: number[] = [];
  const isSeam: number[] = [];
  for (let edge = 0; edge < 3 * faces.count; edge++) {
    if (1 < inPlane.count[inPlane.first[edge]!]! || !hasUvs(faces, Math.floor(edge / 3))) continue;
    borders.push(edge);
    isSeam.push(1 < onSurface.count[onSurface.first[edge]!]! ? 1 : 0);
  }
  const seam = seamsOf(borders, root, onSurface);
  return { ...numbers, place, borders: Uint32Array.from(borders), isSeam: Uint8Array.from(isSeam), seam };
}

/** The seam of each border, by the charts on both sides. */
function seamsOf(borders: number[], root: Uint32Array, { first }: Edges): Uint32Array {
  const sides = new Map<number, number[]>();
  for (const edge of borders) {
    const chart = root[Math.floor(edge / 3)]!;
    sides.set(first[edge]!, [...(sides.get(first[edge]!) ?? []), chart]);
  }
  const numbers = new Map<string, number>();
  return Uint32Array.from(borders, (edge) => {
    const key = sides.get(first[edge]!)!.toSorted((one, other) => one - other).join();
    const number = numbers.get(key) ?? numbers.size;
    numbers.set(key, number);
    return number;
  });
}

/** Returns an id per corner, equal for corners at one place of one mesh. */
function placesOf(faces: Faces): Uint32Array {
  const n = 3 * faces.count;
  const from = bits(faces.positions);
  const words = new Uint32Array(4 * n);
  for (let i = 0; i < n; i++) {
    words.set(from.subarray(3 * i, 3 * i + 3), 4 * i);
    words[4 * i + 3] = faces.mesh[Math.floor(i / 3)]!;
  }
  return firstEqual(words, n);
}

/** Returns an id per corner, equal for corners at one place of one mesh and of one atlas. */
function wedgesOf(faces: Faces, place: Uint32Array): Uint32Array {
  const n = 3 * faces.count;
  const uv = bits(faces.uvs);
  const words = new Uint32Array(4 * n);
  for (let i = 0; i < n; i++) {
    words[4 * i] = place[i]!;
    words[4 * i + 1] = uv[2 * i]!;
    words[4 * i + 2] = uv[2 * i + 1]!;
    words[4 * i + 3] = faces.group[Math.floor(i / 3)]!;
  }
  return firstEqual(words, n);
}

/** Returns a representative per face, the same for all connected faces. */
function joined(count: number, edges: Edges): Uint32Array {
  const parent = Uint32Array.from({ length: count }, (_, face) => face);
  const root = (face: number) => {
    let at = face;
    while (parent[at] !== at) {
      parent[at] = parent[parent[at]!]!;
      at = parent[at]!;
    }
    return at;
  };
  for (let edge = 0; edge < edges.first.length; edge++) {
    const [one, other] = [root(Math.floor(edge / 3)), root(Math.floor(edges.first[edge]! / 3))];
    if (one !== other) parent[Math.max(one, other)] = Math.min(one, other);
  }
  return parent.map((_, face) => root(face));
}

function numbered(root: Uint32Array, faces: Faces) {
  const ofFace = new Uint32Array(root.length);
  const next: number[] = [];
  const number = (isMapped: boolean) => {
    for (let face = 0; face < root.length; face++) {
      if (hasUvs(faces, root[face]!) !== isMapped) continue;
      const g = faces.group[face]!;
      if (root[face] === face) {
        ofFace[face] = next[g] ?? 0;
        next[g] = ofFace[face]! + 1;
      } else {
        ofFace[face] = ofFace[root[face]!]!;
      }
    }
  };
  number(true);
  const ofGroup = [...next];
  number(false);
  return { ofFace, ofGroup, count: ofGroup.reduce((sum, some) => sum + (some ?? 0), 0) };
}

/** Returns the length of all seams and borders on the surface, each counted once. */
export function seamLength(faces: Faces, charts: Charts): number {
  const counted = new Set<number>();
  const width = 3 * faces.count;
  let length = 0;
  charts.borders.forEach((edge, k) => {
    if (!charts.isSeam[k]) return;
    const [from, to] = [charts.place[edge]!, charts.place[next(edge)]!];
    const key = Math.min(from, to) * width + Math.max(from, to);
    if (counted.has(key)) return;
    counted.add(key);
    const p = faces.positions;
    const d = [0, 1, 2].map((axis) => p[3 * from + axis]! - p[3 * to + axis]!);
    length += Math.hypot(...d);
  });
  return length;
}
