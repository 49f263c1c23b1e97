// The drawn faces of a soup: all of them where the scene puts them, or fewer if there are too many.

import { packedNormals } from "./normals";
import { moved, type Soup } from "./soup";
import { firstEqual } from "./weld";

/** Number of faces above which the view is simplified; every figure is still that of all faces. More faces take more
 * memory and time per frame. */
const MAX_DRAWN = 500_000;

/** Grids that are tried for a simplified view, and the share of the drawn faces that is enough. More passes come closer and take
 * longer. */
const PASSES = 4;
const NEARLY = 0.9;

/** Faces for the screen. */
export interface Drawn {
  count: number;
  /** 9 numbers per face, in the scene. */
  positions: Float32Array;
  /** 12 numbers per face. */
  normals: Int8Array;
  /** 6 numbers per face; NaN without UVs. */
  uvs: Float32Array;
  /** Measured face that each drawn one is, or stands for. */
  face: Uint32Array;
  /** Number of faces without simplification. */
  of: number;
}

/** Collects the faces of all parts, copies included. */
export function drawnOf(soup: Soup, begins: number[], chart: Uint32Array): Drawn {
  const of = soup.parts.reduce((sum, part) => sum + part.positions.length / 9, 0);
  const positions = new Float32Array(9 * of);
  const uvs = new Float32Array(6 * of).fill(Number.NaN);
  const face = new Uint32Array(of);
  const normals = new Int8Array(12 * of);
  let at = 0;
  soup.parts.forEach((part, k) => {
    const count = part.positions.length / 9;
    const placed = moved(part.positions, part.matrix);
    positions.set(placed, 9 * at);
    normals.set(packedNormals(placed, part.normals && turned(part.normals, part.matrix)), 12 * at);
    const source = 0 <= part.copyOf ? soup.parts[part.copyOf]! : part;
    if (source.uvs) uvs.set(source.uvs, 6 * at);
    for (let i = 0; i < count; i++) face[at + i] = begins[k]! + i;
    at += count;
  });
  const all = { count: of, positions, normals, uvs, face, of };
  return of <= MAX_DRAWN ? all : simplified(all, chart);
}

/** Returns directions transformed by a matrix, if it scales alike in all directions. */
function turned(normals: Float32Array, matrix: number[]): Float32Array {
  const rotation = [...matrix];
  rotation[12] = rotation[13] = rotation[14] = 0;
  return moved(normals, rotation);
}

/** Merges the corners of one chart in one cell of a grid, and leaves out faces that lose their area thereby. */
function simplified(all: Drawn, chart: Uint32Array): Drawn {
  // A surface in a cube of N cells per side meets about 3N² of them, with two faces each. Thin ones meet fewer, so the grid
  // is refined or coarsened until nearly as many faces are left as are drawn.
  let cells = Math.sqrt(MAX_DRAWN / 6);
  let best: Drawn | null = null;
  for (let pass = 0; pass < PASSES || !best; pass++) {
    const kept = clustered(all, chart, cells);
    if (kept.count <= MAX_DRAWN && (best?.count ?? -1) < kept.count) best = kept;
    if (best === kept && NEARLY * MAX_DRAWN <= kept.count) break;
    cells *= Math.sqrt((((1 + NEARLY) / 2) * MAX_DRAWN) / Math.max(kept.count, 1));
  }
  return best;
}

function clustered(all: Drawn, chart: Uint32Array, cells: number): Drawn {
  const cluster = firstEqual(keys(all, chart, cells), 3 * all.count);
  const kept: number[] = [];
  for (let i = 0; i < all.count; i++) {
    const [a, b, c] = [cluster[3 * i], cluster[3 * i + 1], cluster[3 * i + 2]];
    if (a !== b && b !== c && c !== a) kept.push(i);
  }
  const few: Drawn = {
    count: kept.length,
    positions: new Float32Array(9 * kept.length),
    normals: new Int8Array(12 * kept.length),
    uvs: new Float32Array(6 * kept.length),
    face: Uint32Array.from(kept, (i) => all.face[i]!),
    of: all.of,
  };
  kept.forEach((i, k) => {
    for (let corner = 0; corner < 3; corner++) {
      const [from, to] = [cluster[3 * i + corner]!, 3 * k + corner];
      few.positions.set(all.positions.subarray(3 * from, 3 * from + 3), 3 * to);
      few.normals.set(all.normals.subarray(4 * from, 4 * from + 4), 4 * to);
      few.uvs.set(all.uvs.subarray(2 * from, 2 * from + 2), 2 * to);
    }
  });
  return few;
}

function keys(all: Drawn, chart: Uint32Array, cells: number): Uint32Array {
  const least = [Infinity, Infinity, Infinity];
  const greatest = [-Infinity, -Infinity, -Infinity];
  all.positions.forEach((x, i) => {
    least[i % 3] = Math.min(least[i % 3]!, x);
    greatest[i % 3] = Math.max(greatest[i % 3]!, x);
  });
  const side = Math.max(...greatest.map((x, axis) => x - least[axis]!)) / cells;
  const words = new Uint32Array(12 * all.count);
  for (let corner = 0; corner < 3 * all.count; corner++) {
    for (let axis = 0; axis < 3; axis++) {
      words[4 * corner + axis] = Math.floor((all.positions[3 * corner + axis]! - least[axis]!) / side);
    }
    words[4 * corner + 3] = chart[all.face[Math.floor(corner / 3)]!]!;
  }
  return words;
}
