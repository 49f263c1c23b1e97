// UV sets in the naming of three.js: `uv`, `uv1`, `uv2`, `uv3`, and the file's names for further ones.

import type { Mesh, Object3D } from "three";

/** Returns the attribute name of a set. */
export function attributeOf(set: number): string {
  return set === 0 ? "uv" : set < 4 ? `uv${set}` : `texcoord_${set}`;
}

/** Returns the sets that any mesh of a scene has, in order. */
export function uvSetsOf(scene: Object3D): number[] {
  const sets = new Set<number>();
  scene.traverse((object) => {
    for (const name of Object.keys((object as Partial<Mesh>).geometry?.attributes ?? {})) {
      const number = /^(?:uv|texcoord_)(\d*)$/.exec(name)?.[1];
      if (number !== undefined) sets.add(Number(number));
    }
  });
  return [...sets].sort((one, other) => one - other);
}
