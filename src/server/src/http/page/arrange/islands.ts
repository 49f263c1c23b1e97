// The islands of one atlas: their borders in the plane, whose unit is the height of the texture.

import type { Analysis } from "../analysis/analysis";
import { applied, type Point, type Similarity } from "../viewer/similarity";

/** A box: least x and y, greatest x and y. */
export type Box = [number, number, number, number];

/** Facts about an island. */
export interface Island {
  chart: number;
  /** One of its faces. */
  face: number;
  box: Box;
  /** Its borders: four numbers each. */
  edges: Float64Array;
}

/** Returns the islands of an atlas by their charts. */
export function islandsOf({ borders, chart, group }: Analysis, atlas: number, aspect: number): Map<number, Island> {
  const edges = new Map<number, number[]>();
  borders.face.forEach((face, k) => {
    if (group[face] !== atlas) return;
    const own = edges.get(chart[face]!) ?? [];
    edges.set(chart[face]!, own);
    for (let i = 0; i < 4; i++) own.push(borders.uvs[4 * k + i]! * (i % 2 ? 1 : aspect));
  });
  const faces = new Map<number, number>();
  chart.forEach((one, face) => {
    if (group[face] === atlas && !faces.has(one)) faces.set(one, face);
  });
  return new Map([...edges].map(([one, some]) => {
    const own = Float64Array.from(some);
    return [one, { chart: one, face: faces.get(one)!, box: boxOf(own), edges: own }];
  }));
}

/** Returns an island at another place. */
export function moved(island: Island, by: Similarity): Island {
  const edges = new Float64Array(island.edges.length);
  for (let k = 0; k < edges.length; k += 2) edges.set(applied(by, [island.edges[k]!, island.edges[k + 1]!]), k);
  return { ...island, edges, box: boxOf(edges) };
}

export function middleOf([x0, y0, x1, y1]: Box): Point {
  return [(x0 + x1) / 2, (y0 + y1) / 2];
}

/** Returns the box around several boxes. */
export function around(boxes: Box[]): Box {
  return boxes.reduce(([x0, y0, x1, y1], [u0, v0, u1, v1]) => [Math.min(x0, u0), Math.min(y0, v0), Math.max(x1, u1), Math.max(y1, v1)], [Infinity, Infinity, -Infinity, -Infinity] as Box);
}

function boxOf(edges: Float64Array): Box {
  const box: Box = [Infinity, Infinity, -Infinity, -Infinity];
  for (let k = 0; k < edges.length; k += 2) {
    box[0] = Math.min(box[0], edges[k]!);
    box[1] = Math.min(box[1], edges[k + 1]!);
    box[2] = Math.max(box[2], edges[k]!);
    box[3] = Math.max(box[3], edges[k + 1]!);
  }
  return box;
}
