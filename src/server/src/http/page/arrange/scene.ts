// The islands of the shown atlas at their places: on the GPU, and judged.

import { DataTexture, FloatType, RGBAFormat } from "three";
import type { Analysis } from "../analysis/analysis";
import { ROW } from "../viewer/shaders";
import { IDENTITY, type Similarity } from "../viewer/similarity";
import { keyOf, type Placed } from "./arrangement";
import { isOnPage, Neighbors, type Pages } from "./faults";
import { type Island, islandsOf, moved } from "./islands";

/** Marks of islands. */
const SELECTED = 1;
const LOCKED = 2;
const WRONG = 4;

/** The islands being moved, and all others. */
export interface Moving { charts: Set<number>; neighbors: Neighbors }

/** One atlas of a file. */
export class ArrangedScene {
  readonly islands: Map<number, Island>;
  readonly placed: PlacedTexture;

  constructor(readonly analysis: Analysis, readonly atlas: number, readonly pages: Pages) {
    this.islands = islandsOf(analysis, atlas, pages.aspect);
    this.placed = new PlacedTexture(analysis.atlases[atlas]!.charts);
  }

  /** Returns an island at its place. */
  at(chart: number, places: Placed): Island {
    const island = this.islands.get(chart)!;
    const by = places.get(keyOf(this.atlas, chart));
    return by ? moved(island, by) : island;
  }

  /** Returns the charts that stay. */
  locked(placed: Placed): number[] {
    return [...this.islands.keys()].filter((chart) => placed.has(keyOf(this.atlas, chart)));
  }

  /** Begins to move charts among others: all others, or those that stay where the rest makes room. */
  moving(charts: Set<number>, places: Placed, others: Iterable<number>): Moving {
    const neighbors = [...others].filter((chart) => !charts.has(chart)).map((chart) => this.at(chart, places));
    return { charts: new Set(charts), neighbors: new Neighbors(neighbors, this.pages) };
  }

  /** Returns the misplaced islands. Islands being moved are compared with the others of the movement; afterwards, only
   * islands that stay count, since the others are packed elsewhere or make room. */
  faults(placed: Placed, moving: Moving | null): Set<number> {
    const wrong = new Set<number>();
    const locked = this.locked(placed).map((chart) => this.at(chart, placed));
    for (const island of locked) if (!isOnPage(island, this.pages)) wrong.add(island.chart);
    const neighbors = moving?.neighbors ?? new Neighbors(locked, this.pages);
    for (const island of locked) {
      if (moving && !moving.charts.has(island.chart)) continue;
      const near = neighbors.near(island);
      if (near.size) wrong.add(island.chart);
      for (const { chart } of near) if (placed.has(keyOf(this.atlas, chart))) wrong.add(chart);
    }
    return wrong;
  }

  /** Sends the places and marks of islands to the GPU; those in `placed` stay. */
  show({ placed, places }: { placed: Placed; places: Placed }, selected: Set<number>, wrong: Set<number>): void {
    for (const chart of this.islands.keys()) {
      const key = keyOf(this.atlas, chart);
      const marks = (selected.has(chart) ? SELECTED : 0) | (placed.has(key) ? LOCKED : 0) | (wrong.has(chart) ? WRONG : 0);
      this.placed.put(chart, places.get(key) ?? IDENTITY, marks);
    }
  }

  dispose(): void {
    this.placed.texture.dispose();
  }
}

/** Places of the islands of an atlas on the GPU: two texels per chart, which the shaders of both views read. */
class PlacedTexture {
  readonly texture: DataTexture;
  readonly #numbers: Float32Array;

  constructor(readonly charts: number) {
    const rows = Math.max(1, Math.ceil((2 * charts) / ROW));
    this.#numbers = new Float32Array(4 * ROW * rows);
    this.texture = new DataTexture(this.#numbers, ROW, rows, RGBAFormat, FloatType);
    for (let chart = 0; chart < charts; chart++) this.#numbers[8 * chart] = 1;
    this.texture.needsUpdate = true;
  }

  /** Sets the place of a chart. */
  put(chart: number, { a, b, s, t }: Similarity, marks: number): void {
    this.#numbers.set([a, b, s, t, marks], 8 * chart);
    this.texture.needsUpdate = true;
  }
}
