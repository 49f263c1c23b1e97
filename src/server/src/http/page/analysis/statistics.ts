// Numbers about many faces.

import { type Distortion, type Measure, MEASURES, stretchOf } from "./distortion";

/** Distribution of a measure over faces, weighted by their area on the surface. */
export interface Spread {
  least: number;
  mean: number;
  greatest: number;
  /** Value below which 99 % of the area lie. */
  p99: number;
  /** Range of the histogram; values beyond it are in the last bin. */
  from: number;
  to: number;
  /** Share of the area in each bin. */
  bins: number[];
  /** The faces with the greatest values, worst first; for density the lowest. */
  worst: number[];
}

const BINS = 48;
const WORST = 8;

/** Returns the spread of each of `MEASURES`; null if no face has a value. */
export function spreads(distortion: Distortion, members: Uint32Array): (Spread | null)[] {
  return MEASURES.map((measure, k) => spread(distortion, members, k, measure === "density" ? -1 : 1));
}

function spread({ values, area }: Distortion, members: Uint32Array, k: number, worse: number): Spread | null {
  const value = (face: number) => values[4 * face + k]!;
  const sorted = members.filter((face) => Number.isFinite(value(face))).sort((one, other) => value(one) - value(other));
  if (!sorted.length) return null;
  let [total, sum] = [0, 0];
  for (const face of sorted) {
    total += area[face]!;
    sum += area[face]! * (worse < 0 ? value(face) ** 2 : value(face));
  }
  // The mean density is that of the area, as in reports.
  const mean = worse < 0 ? Math.sqrt(sum / total) : sum / total;
  const quantile = (share: number) => {
    let below = 0;
    for (const face of sorted) {
      below += area[face]!;
      if (share * total <= below) return value(face);
    }
    return value(sorted.at(-1)!);
  };
  const [least, greatest, p99] = [value(sorted[0]!), value(sorted.at(-1)!), quantile(0.99)];
  const from = worse < 0 ? quantile(0.002) : least;
  const to = worse < 0 ? quantile(0.998) : quantile(0.995);
  const step = (to - from || Math.max(Math.abs(to) * 0.01, 1e-9)) / BINS;
  const bins = new Array<number>(BINS).fill(0);
  for (const face of sorted) {
    const bin = Math.min(Math.max(Math.floor((value(face) - from) / step), 0), BINS - 1);
    bins[bin]! += area[face]! / total;
  }
  const ends = worse < 0 ? sorted.slice(0, WORST) : sorted.slice(-WORST).reverse();
  return { least, mean, greatest, p99, from, to: from + BINS * step, bins, worst: [...ends] };
}

/** Returns the ends of a heat map's scale: shares of stretch, or texels per unit of length.
 *
 * A fixed scale ends where everything is doubled, so that two results have the same colors; a fitted one ends where 99 %
 * of the area do. Densities are compared with their mean. */
export function rangeOf(measure: Measure, { least, mean, greatest, p99 }: Spread, scale: "fixed" | "fitted"): [number, number] {
  const isFixed = scale === "fixed";
  if (measure === "density") {
    const far = isFixed ? 2 : Math.max(greatest / mean, mean / least, 1.02);
    return [mean / far, mean * far];
  }
  return [0, isFixed ? 1 : Math.max(stretchOf(measure, p99), 0.01)];
}
