// The islands of the shown atlas at their places: on the GPU, and judged.

import type { Analysis } from "../analysis/analysis";
import { LOCKED, PlacedTexture, SELECTED, WRONG } from "../viewer/placed";
import { IDENTITY } from "../viewer/similarity";
import { keyOf, type Placed } from "./arrangement";
import { isOnPage, Neighbors, type Pages } from "./faults";
import { type Island, islandsOf, moved } from "./islands";

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
  at(chart: number, placed: Placed): Island {
    const island = this.islands.get(chart)!;
    const by = placed.get(keyOf(this.atlas, chart));
    return by ? moved(island, by) : island;
  }

  /** Returns the charts that stay. */
  locked(placed: Placed): number[] {
    return [...this.islands.keys()].filter((chart) => placed.has(keyOf(this.atlas, chart)));
  }

  /** Begins to move charts. */
  moving(charts: Set<number>, placed: Placed): Moving {
    const others = [...this.islands.keys()].filter((chart) => !charts.has(chart));
    return { charts: new Set(charts), neighbors: new Neighbors(others.map((chart) => this.at(chart, placed)), this.pages) };
  }

  /** Returns the misplaced islands. Islands being moved are compared with all others; afterwards, only islands that
   * stay count, since the others are packed elsewhere. */
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

  /** Sends the places and marks of islands to the GPU. */
  show(placed: Placed, selected: Set<number>, wrong: Set<number>): void {
    for (const chart of this.islands.keys()) {
      const by = placed.get(keyOf(this.atlas, chart));
      this.placed.put(chart, by ?? IDENTITY, (selected.has(chart) ? SELECTED : 0) | (by ? LOCKED : 0) | (wrong.has(chart) ? WRONG : 0));
    }
  }

  dispose(): void {
    this.placed.texture.dispose();
  }
}
