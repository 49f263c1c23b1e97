// The drawn vertices of a pulled mesh in the coordinates of the views, and conversion to those of the mesh.

import { BufferAttribute, DynamicDrawUsage, Vector3 } from "three";
import type { LiveMesh } from "../live/decode";
import type { Touched } from "./scene";

/** The drawn part of a mesh. */
export class Seen {
  readonly attribute: BufferAttribute;
  /** Drawn vertices at rest and now, in the mesh's coordinates. */
  readonly #rest: Float64Array;
  #now: Float64Array;

  constructor(readonly mesh: LiveMesh, readonly down: number | null) {
    this.#rest = this.#carried(mesh.rest);
    this.#now = this.#rest;
    this.attribute = new BufferAttribute(new Float32Array((3 * this.#rest.length) / mesh.dim), 3);
    this.attribute.setUsage(DynamicDrawUsage);
    this.move(mesh.rest);
  }

  /** Returns the drawn vertices for these positions of the mesh's vertices. */
  #carried(positions: ArrayLike<number>): Float64Array {
    const { dim, skin, weights } = this.mesh;
    if (!skin.length) return Float64Array.from(positions);
    const carried = new Float64Array((dim * skin.length) / 4);
    for (let k = 0; k < skin.length; k++) {
      for (let c = 0; c < dim; c++) carried[dim * (k >> 2) + c]! += weights[k]! * positions[dim * skin[k]! + c]!;
    }
    return carried;
  }

  move(positions: ArrayLike<number>): void {
    this.#now = this.#carried(positions);
    const { dim } = this.mesh;
    const { array, count } = this.attribute;
    for (let v = 0; v < count; v++) {
      array[3 * v] = this.#now[dim * v]!;
      array[3 * v + 1] = this.#turned(this.#now[dim * v + 1]!);
      if (dim === 3) array[3 * v + 2] = this.#now[dim * v + 2]!;
    }
    this.attribute.needsUpdate = true;
  }

  /** Returns the UVs of the corners of triangles, six numbers each, v up. */
  uvs(): Float32Array {
    const { array } = this.attribute;
    return Float32Array.from({ length: 2 * this.mesh.triangles.length }, (_, k) => array[3 * this.mesh.triangles[k >> 1]! + (k & 1)]!);
  }

  #turned(y: number): number {
    return this.down === null ? y : this.down - y;
  }

  /** Converts a place to the coordinates of the views. */
  outward([x, y, z = 0]: number[]): Vector3 {
    return new Vector3(x!, this.#turned(y!), z);
  }

  /** Converts a place to the coordinates of the mesh. */
  inward({ x, y, z }: Vector3): number[] {
    return this.mesh.dim === 2 ? [x, this.#turned(y)] : [x, y, z];
  }

  /** Returns the least and greatest coordinates in a view of the plane. */
  box(): [number, number, number, number] {
    const { array } = this.attribute;
    const box: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let k = 0; k < array.length; k += 3) {
      box[0] = Math.min(box[0], array[k]!);
      box[1] = Math.min(box[1], array[k + 1]!);
      box[2] = Math.max(box[2], array[k]!);
      box[3] = Math.max(box[3], array[k + 1]!);
    }
    return box;
  }

  /** Longest side of the box at rest. */
  get extent(): number {
    const { dim } = this.mesh;
    const sides = Array.from({ length: dim }, (_, c) => {
      let [low, high] = [Infinity, -Infinity];
      for (let k = c; k < this.#rest.length; k += dim) [low, high] = [Math.min(low, this.#rest[k]!), Math.max(high, this.#rest[k]!)];
      return high - low;
    });
    return Math.max(...sides);
  }

  #corner(positions: Float64Array, triangle: number, k: number): number[] {
    const { dim, triangles } = this.mesh;
    const v = triangles[3 * triangle + k]!;
    return [...positions.subarray(dim * v, dim * (v + 1))];
  }

  /** Returns the place in the first triangle that contains a point of the plane. */
  touchPlane(point: number[]): Touched | null {
    for (let t = 0; t < this.mesh.triangles.length / 3; t++) {
      const weights = this.#weights(t, point);
      if (weights && weights.every((w) => 0 <= w)) return this.#touched(t, weights);
    }
    return null;
  }

  /** Returns the place at a point of a triangle in space. */
  touchFace(triangle: number, point: Vector3): Touched {
    const [a, b, c] = [0, 1, 2].map((k) => new Vector3(...(this.#corner(this.#now, triangle, k) as [number, number, number]))) as [Vector3, Vector3, Vector3];
    const area = (p: Vector3, q: Vector3, r: Vector3) => q.clone().sub(p).cross(r.clone().sub(p));
    const whole = area(a, b, c);
    const share = (part: Vector3) => part.dot(whole) / whole.lengthSq();
    return this.#touched(triangle, [share(area(point, b, c)), share(area(point, c, a)), share(area(point, a, b))]);
  }

  #weights(triangle: number, [x, y]: number[]): number[] | null {
    const [a, b, c] = [0, 1, 2].map((k) => this.#corner(this.#now, triangle, k)) as [number[], number[], number[]];
    const area = (p: number[], q: number[]) => (p[0]! - x!) * (q[1]! - y!) - (p[1]! - y!) * (q[0]! - x!);
    const parts = [area(b, c), area(c, a), area(a, b)];
    const whole = parts.reduce((sum, part) => sum + part, 0);
    return whole === 0 ? null : parts.map((part) => part / whole);
  }

  #touched(triangle: number, weights: number[]): Touched {
    const mean = (positions: Float64Array) => {
      const corners = weights.map((_, k) => this.#corner(positions, triangle, k));
      return corners[0]!.map((_, c) => weights.reduce((sum, w, k) => sum + w * corners[k]![c]!, 0));
    };
    return { at: mean(this.#rest), to: mean(this.#now) };
  }
}
