// Places of the islands of an atlas on the GPU: two texels per chart, which the shaders of both views read.

import { DataTexture, FloatType, RGBAFormat } from "three";
import type { Similarity } from "./similarity";
import { ROW } from "./shaders";

/** Marks of islands. */
export const SELECTED = 1;
export const LOCKED = 2;
export const WRONG = 4;

/** Texture with the places of the islands of one atlas. */
export class PlacedTexture {
  readonly texture: DataTexture;
  readonly #numbers: Float32Array;

  constructor(readonly charts: number) {
    const rows = Math.max(1, Math.ceil((2 * charts) / ROW));
    this.#numbers = new Float32Array(4 * ROW * rows);
    this.texture = new DataTexture(this.#numbers, ROW, rows, RGBAFormat, FloatType);
    for (let chart = 0; chart < charts; chart++) this.#numbers[8 * chart] = 1;
    this.texture.needsUpdate = true;
  }

  /** Sets the place of a chart. */
  put(chart: number, { a, b, s, t }: Similarity, marks: number): void {
    this.#numbers.set([a, b, s, t, marks], 8 * chart);
    this.texture.needsUpdate = true;
  }
}
