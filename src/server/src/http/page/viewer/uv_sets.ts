// UV sets, as three.js names them: `uv`, `uv1`, `uv2`, `uv3`, and those beyond as the file does.

import type { Mesh, Object3D } from "three";

/** The attribute of a set. */
export function attributeOf(set: number): string {
  return set === 0 ? "uv" : set < 4 ? `uv${set}` : `texcoord_${set}`;
}

/** The sets that any mesh of a scene has, in their order. */
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
