// The job that packs the other islands around those that stay.

import type { Analysis } from "../analysis/analysis";
import type { Facts } from "../app/source";
import { applied, isStill, scaleOf, type Similarity, turnOf } from "../viewer/similarity";
import type { UvRecord } from "../viewer/loading";
import { keyOf, type Placed } from "./arrangement";
import type { Pages } from "./faults";
import { type Island, islandsOf, middleOf } from "./islands";

/** A primitive of the file with the UV set that was written. */
type Primitive = { mesh: number; primitive: number; texcoord: number };

/** An island in the format of the service: v points down, as in the file. */
export interface PlacedIsland { primitive: number; face: number; move?: [number, number]; turn?: number; scale?: number; pivot?: [number, number] }

/** Returns the islands that stay, of all atlases. */
export function wished(analysis: Analysis, aspect: number, placed: Placed, facts: Facts, primitives: Primitive[]): PlacedIsland[] {
  return analysis.atlases.flatMap((_, atlas) => [...islandsOf(analysis, atlas, aspect).values()].flatMap((island) => {
    const by = placed.get(keyOf(atlas, island.chart));
    return by ? [put(island, by, aspect, facts, primitives)] : [];
  }));
}

function put({ face, box }: Island, by: Similarity, aspect: number, { origins }: Facts, primitives: Primitive[]): PlacedIsland {
  const origin = origins.find(({ begin, count }) => begin <= face && face < begin + count)!;
  const primitive = primitives.findIndex((one) => one.mesh === origin.mesh && one.primitive === origin.primitive);
  const named = { primitive, face: face - origin.begin };
  if (isStill(by)) return named;
  const middle = middleOf(box);
  const [x, y] = applied(by, middle);
  return { ...named, pivot: [middle[0] / aspect, 1 - middle[1]], move: [(x - middle[0]) / aspect, middle[1] - y], turn: -turnOf(by), scale: scaleOf(by) };
}

/** Returns the distance in texels that islands keep on the finest mip level. */
function paddingOf({ padding = 2, mips = 0 }: UvRecord): number {
  return padding << mips;
}

/** Returns the pages on which islands may lie. */
export function pagesOf({ record, texture: { width, height } }: Facts): Pages {
  return { count: record.pages ?? 1, aspect: width / height, texel: 1 / height, padding: paddingOf(record) };
}

/** Returns the options of the job, as the UVs were made; null if primitives have different UV sets. */
export function optionsOf({ record, texture }: Facts, primitives: Primitive[], islands: PlacedIsland[]): Record<string, unknown> | null {
  const [source, ...others] = new Set(primitives.map(({ texcoord }) => texcoord));
  if (others.length) return null;
  const { group_by = "scene", pages = 1, resolution = texture.width } = record;
  return { islands, resolution, padding: paddingOf(record), pages, group_by, source_texcoord: source };
}
