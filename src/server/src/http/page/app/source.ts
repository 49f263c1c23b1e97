// Selection of the file and the UVs that are shown.

import type { Texture } from "../analysis/soup";
import type { Bundle, Loaded, UvRecord } from "../viewer/loading";
import type { Origin } from "../viewer/soups";
import { uvSetsOf } from "../viewer/uv_sets";

/** A file to show. */
export interface Source extends Bundle {
  /** Identifies the model: files that share it are seen by the same cameras. */
  model: string;
  /** Record of its UVs, if the file has none. */
  record?: UvRecord;
  /** The UV set that a job wrote. */
  texcoord?: (mesh: number, primitive: number) => number;
  /** Set if the mesh turns until a person takes over. */
  isTurning?: boolean;
  /** Set if relaxing charts stay until another file is shown. */
  isInput?: boolean;
  /** Direction from which it is seen first. */
  from?: readonly [number, number, number];
}

/** The UVs that are shown. */
export interface Uvs {
  /** Record of how they were made. */
  record: UvRecord;
  /** The set of a primitive. */
  texcoord: (mesh: number, primitive: number) => number;
  /** Sets of the file, the shown one, and the one shown first. */
  sets: number[];
  set: number;
  first: number;
}

/** Facts about a file that is shown. */
export interface Facts extends Uvs { source: Source; texture: Texture; origins: Origin[]; missing: string[] }

/** Returns the UVs of a chosen set, or of the one shown first. */
export function uvsOf(source: Source, loaded: Loaded, chosen: number | null): Uvs {
  const record = source.record ?? loaded.record ?? {};
  const texcoord = source.texcoord ?? (() => record.texcoord ?? 0);
  const [sets, first] = [uvSetsOf(loaded.scene), texcoord(0, 0)];
  if (chosen === null || chosen === first || !sets.includes(chosen)) return { record, texcoord, sets, set: first, first };
  // Other sets were made differently: their faces lie in the textures of their materials, with an unknown padding.
  const { resolution } = record;
  return { record: { resolution, texcoord: chosen, group_by: "material" }, texcoord: () => chosen, sets, set: chosen, first };
}
