// Misplaced islands: closer to others than the padding, or beyond the borders of a page.

import { segmentDistance } from "../analysis/gaps";
import type { Box, Island } from "./islands";

/** Share of a texel below which a difference is rounding. */
const TOLERANCE = 1e-3;

/** The pages of an atlas, in units of the height of the texture. */
export interface Pages { count: number; aspect: number; texel: number; padding: number }

/** Returns whether an island lies on one page. */
export function isOnPage({ box: [x0, y0, x1, y1] }: Island, { count, aspect, texel }: Pages): boolean {
  const page = Math.floor((x0 + x1) / 2 / aspect);
  const beyond = TOLERANCE * texel;
  return 0 <= page && page < count && page * aspect - beyond <= x0 && x1 <= (page + 1) * aspect + beyond && -beyond <= y0 && y1 <= 1 + beyond;
}

/** Islands that can be searched for neighbors. */
export class Neighbors {
  readonly #gap: number;
  readonly #cell: number;
  /** Edges by the cells that they touch: the island and the index among its edges. */
  readonly #cells = new Map<string, [Island, number][]>();

  constructor(readonly islands: Island[], { texel, padding }: Pages) {
    this.#gap = Math.max(padding - TOLERANCE, TOLERANCE) * texel;
    this.#cell = Math.max(4 * this.#gap, 1 / 64);
    for (const island of islands) {
      for (let k = 0; k < island.edges.length; k += 4) this.#visit(edgeBox(island.edges, k), (cell) => this.#at(cell).push([island, k]));
    }
  }

  #at(cell: string): [Island, number][] {
    const found = this.#cells.get(cell) ?? [];
    this.#cells.set(cell, found);
    return found;
  }

  #visit([x0, y0, x1, y1]: Box, use: (cell: string) => void): void {
    const index = (x: number) => Math.floor(x / this.#cell);
    for (let i = index(x0); i <= index(x1); i++) {
      for (let j = index(y0); j <= index(y1); j++) use(`${i},${j}`);
    }
  }

  /** Returns the islands that overlap an island or are too close to it. */
  near(island: Island): Set<Island> {
    const found = new Set<Island>();
    const own = grown(island.box, this.#gap);
    const candidates = this.islands.filter((other) => other.chart !== island.chart && meet(own, other.box));
    for (const other of candidates) if (holds(island, other) || holds(other, island)) found.add(other);
    if (found.size === candidates.length) return found;
    for (let k = 0; k < island.edges.length; k += 4) {
      this.#visit(grown(edgeBox(island.edges, k), this.#gap), (cell) => {
        for (const [other, at] of this.#cells.get(cell) ?? []) {
          if (other.chart === island.chart || found.has(other)) continue;
          if (segmentDistance(island.edges, k, other.edges, at) < this.#gap || cross(island.edges, k, other.edges, at)) found.add(other);
        }
      });
    }
    return found;
  }
}

function edgeBox(edges: Float64Array, k: number): Box {
  const [x0, y0, x1, y1] = [edges[k]!, edges[k + 1]!, edges[k + 2]!, edges[k + 3]!];
  return [Math.min(x0, x1), Math.min(y0, y1), Math.max(x0, x1), Math.max(y0, y1)];
}

function grown([x0, y0, x1, y1]: Box, by: number): Box {
  return [x0 - by, y0 - by, x1 + by, y1 + by];
}

function meet(a: Box, b: Box): boolean {
  return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

function side(e: Float64Array, k: number, x: number, y: number): number {
  return Math.sign((e[k + 2]! - e[k]!) * (y - e[k + 1]!) - (e[k + 3]! - e[k + 1]!) * (x - e[k]!));
}

function cross(a: Float64Array, i: number, b: Float64Array, j: number): boolean {
  const parts = (e: Float64Array, k: number, f: Float64Array, m: number) => side(e, k, f[m]!, f[m + 1]!) * side(e, k, f[m + 2]!, f[m + 3]!) < 0;
  return parts(a, i, b, j) && parts(b, j, a, i);
}

/** Returns whether a corner of another island lies inside, by the winding number of the border: the scene may show
 * it several times. */
function holds({ edges, box }: Island, other: Island): boolean {
  const [x, y] = [other.edges[0]!, other.edges[1]!];
  if (!meet(box, [x, y, x, y])) return false;
  let winding = 0;
  for (let k = 0; k < edges.length; k += 4) {
    const [x0, y0, x1, y1] = [edges[k]!, edges[k + 1]!, edges[k + 2]!, edges[k + 3]!];
    if (y0 <= y !== y1 <= y && x < x0 + ((x1 - x0) * (y - y0)) / (y1 - y0)) winding += y0 <= y ? 1 : -1;
  }
  return winding !== 0;
}
