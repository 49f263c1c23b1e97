// What of a file is shown.

import type { Texture } from "../analysis/soup";
import type { Bundle, Loaded, UvRecord } from "../viewer/loading";
import type { Origin } from "../viewer/soups";
import { uvSetsOf } from "../viewer/uv_sets";

/** What of a file is to be shown. */
export interface Source extends Bundle {
  /** How its UVs were made, where the file does not say. */
  record?: UvRecord;
  /** The UV set that a job wrote. */
  texcoord?: (mesh: number, primitive: number) => number;
  /** Whether it turns until a person takes over. */
  isTurning?: boolean;
  /** Whether charts that relax stay until another file is shown. */
  isInput?: boolean;
  /** From where it is seen first. */
  from?: readonly [number, number, number];
}

/** Which UVs are shown. */
export interface Uvs {
  /** How they were made. */
  record: UvRecord;
  /** The set of a primitive. */
  texcoord: (mesh: number, primitive: number) => number;
  /** The sets that the file has, the one that is shown, and the one that is shown first. */
  sets: number[];
  set: number;
  first: number;
}

/** What is known of a file that is shown. */
export interface Facts extends Uvs { source: Source; texture: Texture; origins: Origin[] }

/** The UVs of a set that the file has, or those that are shown first. */
export function uvsOf(source: Source, loaded: Loaded, chosen: number | null): Uvs {
  const record = source.record ?? loaded.record ?? {};
  const texcoord = source.texcoord ?? (() => record.texcoord ?? 0);
  const [sets, first] = [uvSetsOf(loaded.scene), texcoord(0, 0)];
  if (chosen === null || chosen === first || !sets.includes(chosen)) return { record, texcoord, sets, set: first, first };
  // Another set was made otherwise: its faces lie in the textures of their materials, at a padding that is not known.
  const { resolution } = record;
  return { record: { resolution, texcoord: chosen, group_by: "material" }, texcoord: () => chosen, sets, set: chosen, first };
}
