// The look of the views: chosen settings, and the element under the pointer.

import { DataTexture, Vector2, Vector4, type Texture } from "three";

/** Fillings of faces. */
export const SHADES = ["plain", "charts", "checker", "heat", "image", "material", "padding"] as const;
export type Shade = (typeof SHADES)[number];

/** Values of uniforms that the shaders of both views share. */
export function uniforms() {
  const none = new DataTexture(new Uint8Array([255, 255, 255, 255]), 1, 1);
  none.needsUpdate = true;
  return {
    uValues: { value: none as Texture },
    uIds: { value: none as Texture },
    uShade: { value: 0 },
    uMeasure: { value: 0 },
    /** Ends of the heat map's scale: shares of stretch, or texels per unit of length. */
    uRange: { value: new Vector2(0, 1) },
    uChecker: { value: new Vector2(32, 32) },
    uImage: { value: none as Texture },
    /** The filled texture, its number of pages, and its level that is shown. */
    uTexels: { value: none as Texture },
    uPages: { value: 1 },
    uLevel: { value: 0 },
    /** The hovered and the selected face, chart with its group, and seam; -1 for none. */
    uHover: { value: new Vector4(-1, -1, -1, -1) },
    uSelected: { value: new Vector4(-1, -1, -1, -1) },
    /** The only shown chart with its group; -1 for all. */
    uOnly: { value: new Vector2(-1, -1) },
    uAtlas: { value: 0 },
    uAspect: { value: 1 },
    uWire: { value: 0 },
    uProblems: { value: 1 },
    /** Set if all seams are drawn, not only those of what is pointed at or selected. */
    uSeams: { value: 1 },
    /** Set while islands are arranged, and their places. */
    uArranging: { value: 0 },
    uPlaced: { value: none as Texture },
    uViewport: { value: new Vector2(1, 1) },
    uPixelRatio: { value: 1 },
  };
}

/** Returns uniforms for another file with the same looks, in which nothing is pointed at or selected. */
export function uniformsBeside(shared: Uniforms): Uniforms {
  const { uValues, uIds, uAtlas, uAspect, uChecker, uTexels, uPages, uLevel, uHover, uSelected, uOnly, uArranging } = uniforms();
  return { ...shared, uValues, uIds, uAtlas, uAspect, uChecker, uTexels, uPages, uLevel, uHover, uSelected, uOnly, uArranging };
}

export type Uniforms = ReturnType<typeof uniforms>;
