// The job that packs the other islands around those that stay.

import type { Analysis } from "../analysis/analysis";
import type { Facts } from "../app/source";
import { applied, isStill, scaleOf, type Similarity, turnOf } from "../viewer/similarity";
import type { UvRecord } from "../viewer/loading";
import { keyOf, type Placed } from "./arrangement";
import type { Pages } from "./faults";
import { type Island, islandsOf, middleOf } from "./islands";

/** A primitive of the file with the UV set that was written. */
export type Primitive = { mesh: number; primitive: number; texcoord: number };

/** An island in the format of the service: v points down, as in the file. */
export interface PlacedIsland { primitive: number; face: number; move?: [number, number]; turn?: number; scale?: number; pivot?: [number, number] }

/** Returns the islands that stay, of all atlases. */
export function wished(analysis: Analysis, aspect: number, placed: Placed, facts: Facts, primitives: Primitive[]): PlacedIsland[] {
  return analysis.atlases.flatMap((_, atlas) => [...islandsOf(analysis, atlas, aspect).values()].flatMap((island) => {
    const by = placed.get(keyOf(atlas, island.chart));
    return by ? [put(island, by, aspect, facts, primitives)] : [];
  }));
}

function put(island: Island, by: Similarity, aspect: number, facts: Facts, primitives: Primitive[]): PlacedIsland {
  const named = nameOf(island, facts, primitives);
  return isStill(by) ? named : { ...named, ...placement(island, by, aspect) };
}

/** Returns the handle of an island in a live session, with its whole place. */
export function placementOf(island: Island, by: Similarity, { facts, primitives }: { facts: Facts; primitives: Primitive[] }): PlacedIsland {
  return { ...nameOf(island, facts, primitives), ...placement(island, by, facts.texture.width / facts.texture.height) };
}

function nameOf({ face }: Island, { origins }: Facts, primitives: Primitive[]): PlacedIsland {
  const origin = origins.find(({ begin, count }) => begin <= face && face < begin + count)!;
  const primitive = primitives.findIndex((one) => one.mesh === origin.mesh && one.primitive === origin.primitive);
  return { primitive, face: face - origin.begin };
}

function placement({ box }: Island, by: Similarity, aspect: number): Omit<Required<PlacedIsland>, "primitive" | "face"> {
  const middle = middleOf(box);
  const [x, y] = applied(by, middle);
  return { pivot: [middle[0] / aspect, 1 - middle[1]], move: [(x - middle[0]) / aspect, middle[1] - y], turn: -turnOf(by), scale: scaleOf(by) };
}

/** Returns the number of faces before each primitive, and of all; null if the view does not show one of them. */
export function facesBefore({ origins }: Facts, primitives: Primitive[]): number[] | null {
  const before = [0];
  for (const { mesh, primitive } of primitives) {
    const origin = origins.find((one) => one.mesh === mesh && one.primitive === primitive);
    if (!origin) return null;
    before.push(before.at(-1)! + origin.count);
  }
  return before;
}

/** Returns the distance in texels that islands keep on the finest mip level. */
function paddingOf({ padding = 2, mips = 0 }: UvRecord): number {
  return padding << mips;
}

/** Returns the pages on which islands may lie. */
export function pagesOf({ record, texture: { width, height } }: Facts): Pages {
  return { count: record.pages ?? 1, aspect: width / height, texel: 1 / height, padding: paddingOf(record) };
}

/** Returns the options of a job or a session, as the UVs were made; null if primitives have different UV sets. */
export function optionsOf({ record, texture }: Facts, primitives: Primitive[]): Record<string, unknown> | null {
  const [source, ...others] = new Set(primitives.map(({ texcoord }) => texcoord));
  if (others.length) return null;
  const { group_by = "scene", pages = 1, resolution = texture.width } = record;
  return { resolution, padding: paddingOf(record), pages, group_by, source_texcoord: source };
}
