// A shown file: its scene, its analysis, and its data on the GPU.

import { Box2, Box3, type Mesh, type MeshStandardMaterial, Sphere, type Texture, Vector2, Vector3 } from "three";
import type { Analysis } from "../analysis/analysis";
import { dispose, type Loaded } from "./loading";
import type { Uniforms } from "./look";
import { type Surface, surfaceOf } from "./surface";

/** Place of a drawn face. */
export interface FacePlace {
  /** Center on the surface, and the direction that the face points to. */
  middle: Vector3;
  normal: Vector3;
  /** Center in the plane. */
  u: number;
  v: number;
  /** Longest sides, on the surface and in the plane. */
  size: number;
  planeSize: number;
}

/** A file that is loaded, analyzed and ready to be drawn. */
export class Model {
  readonly surface: Surface;
  /** Sphere around everything that is drawn. */
  readonly sphere: Sphere;
  readonly aspect: number;
  readonly #set: number;
  readonly #firstDrawn = new Map<number, number>();

  /** Creates the model with the UVs of a set, for a texture of this aspect. */
  constructor(readonly loaded: Loaded, readonly analysis: Analysis, { set, aspect }: { set: number; aspect: number }, shared: Uniforms) {
    this.aspect = aspect;
    this.#set = set;
    this.surface = surfaceOf(analysis, shared);
    this.sphere = this.surface.layers.solid.surface.geometry.boundingSphere ?? new Sphere(new Vector3(), 1);
    analysis.drawn.face.forEach((face, k) => {
      if (!this.#firstDrawn.has(face)) this.#firstDrawn.set(face, k);
    });
  }

  /** Set if it lies in a plane of constant z, as bodies of the plane do. */
  get isFlat(): boolean {
    const { positions } = this.analysis.drawn;
    return positions.every((z, i) => i % 3 !== 2 || z === positions[2]);
  }

  /** Returns the place of a face, or of its chart if a simplified view does not draw it. */
  place(face: number): FacePlace | null {
    const drawn = this.#firstDrawn.get(face) ?? this.#drawnOfChart(face);
    if (drawn === undefined) return null;
    const { positions, uvs } = this.analysis.drawn;
    const [a, b, c] = [0, 3, 6].map((k) => new Vector3().fromArray(positions, 9 * drawn + k)) as [Vector3, Vector3, Vector3];
    const plane = [0, 2, 4].map((k) => new Vector3(uvs[6 * drawn + k]! * this.aspect, uvs[6 * drawn + k + 1]!, 0)) as [Vector3, Vector3, Vector3];
    const middle = plane[0].clone().add(plane[1]).add(plane[2]).divideScalar(3);
    return {
      middle: a.clone().add(b).add(c).divideScalar(3),
      normal: b.clone().sub(a).cross(c.clone().sub(a)),
      u: middle.x, v: middle.y, size: longest(a, b, c), planeSize: longest(...plane),
    };
  }

  /** Returns a sphere around drawn faces and a rectangle around them in the plane; null if none of them is drawn. */
  extent(isMeant: (face: number) => boolean): { sphere: Sphere; rectangle: [number, number, number, number] | null } | null {
    const { face, positions, uvs } = this.analysis.drawn;
    const [box, area] = [new Box3(), new Box2()];
    face.forEach((one, k) => {
      if (!isMeant(one)) return;
      for (let corner = 3 * k; corner < 3 * k + 3; corner++) {
        box.expandByPoint(new Vector3().fromArray(positions, 3 * corner));
        if (!Number.isNaN(uvs[2 * corner])) area.expandByPoint(new Vector2(uvs[2 * corner]! * this.aspect, uvs[2 * corner + 1]!));
      }
    });
    if (box.isEmpty()) return null;
    return { sphere: box.getBoundingSphere(new Sphere()), rectangle: area.isEmpty() ? null : [area.min.x, area.min.y, area.max.x, area.max.y] };
  }

  #drawnOfChart(face: number): number | undefined {
    const { chart, group, drawn } = this.analysis;
    const found = drawn.face.findIndex((other) => chart[other] === chart[face] && group[other] === group[face]);
    return 0 <= found ? found : undefined;
  }

  /** Returns the picture that the materials of an atlas show in the shown UV set. */
  picture(): Texture | null {
    let found: Texture | null = null;
    this.loaded.scene.traverse((object) => {
      for (const material of [(object as Mesh).material ?? []].flat()) {
        const { map } = material as MeshStandardMaterial;
        if (map && map.channel === this.#set) found ??= map;
      }
    });
    return found;
  }

  dispose(): void {
    this.surface.dispose();
    dispose(this.loaded.scene);
  }
}

function longest(a: Vector3, b: Vector3, c: Vector3): number {
  return Math.max(a.distanceTo(b), b.distanceTo(c), c.distanceTo(a));
}
