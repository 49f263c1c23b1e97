// The surface beside its pulled UVs: seen with checker, heat map or texture as the UVs are at the moment.

import { CanvasTexture, type DataTexture, type Object3D, RepeatWrapping, type Sphere, type Texture as Image } from "three";
import type { Analysis } from "../analysis/analysis";
import { distortionOf } from "../analysis/distortion";
import type { Faces, Texture } from "../analysis/soup";
import { SHADES, type Shade, uniforms } from "../viewer/look";
import type { Origin } from "../viewer/soups";
import { type Surface, surfaceOf } from "../viewer/surface";

/** What the page shows of the file whose UVs are pulled. */
export interface Shown {
  analysis: Analysis;
  origins: Origin[];
  texture: Texture;
  /** Picture of its material, or one that was chosen for the faces. */
  picture: Image | null;
}

/** Greatest difference of UVs at rest that still are those of the shown file: its UVs have 32 bits. */
const SAME = 1e-5;

/** The surface on the GPU of the pull view. */
export class Beside {
  readonly uniforms = uniforms();
  readonly #surface: Surface;
  readonly #faces: Faces;
  /** The pulled triangle that each drawn face is. */
  readonly #triangle: Uint32Array;
  readonly #picture: Image | null;
  readonly #texture: Texture;

  private constructor({ analysis, texture, picture }: Shown, triangle: Uint32Array) {
    const { drawn } = analysis;
    const uvs = drawn.uvs.slice();
    // Measured apart from other atlases, as in the views of the page.
    const group = Uint16Array.from(drawn.face, (face) => analysis.group[face]!);
    this.#faces = { count: drawn.count, positions: drawn.positions, uvs, mesh: new Uint32Array(drawn.count), group };
    this.#triangle = triangle;
    this.#texture = texture;
    this.#picture = picture && upright(picture);
    this.#surface = surfaceOf({ ...analysis, drawn: { ...drawn, uvs } }, this.uniforms);
    this.uniforms.uProblems.value = 0;
    this.uniforms.uChecker.value.set(32, (32 * texture.height) / texture.width);
    if (this.#picture) this.uniforms.uImage.value = this.#picture;
  }

  /** Returns the surface of pulled UVs, six numbers per triangle, if the page shows all of its faces with these UVs. */
  static of(shown: Shown | null, uvs: Float32Array): Beside | null {
    const triangle = shown && trianglesOf(shown);
    if (!triangle) return null;
    const { drawn } = shown.analysis;
    const isSame = drawn.uvs.every((x, i) => Number.isNaN(x) || Math.abs(x - uvs[6 * triangle[Math.floor(i / 6)]! + (i % 6)]!) < SAME);
    return isSame ? new Beside(shown, triangle) : null;
  }

  get things(): Object3D[] {
    const { surface, borders } = this.#surface.layers.solid;
    return [surface, borders];
  }

  get sphere(): Sphere | null {
    return this.#surface.layers.solid.surface.geometry.boundingSphere;
  }

  get hasPicture(): boolean {
    return this.#picture !== null;
  }

  /** Fills the faces; a material is its picture. */
  fill(shade: Shade): void {
    this.uniforms.uShade.value = SHADES.indexOf(shade === "material" ? "image" : shade);
  }

  /** Takes the present UVs, six numbers per triangle. */
  move(uvs: Float32Array): void {
    const own = this.#faces.uvs;
    this.#triangle.forEach((triangle, k) => {
      if (!Number.isNaN(own[6 * k])) own.set(uvs.subarray(6 * triangle, 6 * triangle + 6), 6 * k);
    });
    this.#surface.layers.solid.surface.geometry.attributes.faceUv!.needsUpdate = true;
    if (this.uniforms.uShade.value === SHADES.indexOf("heat")) this.#measure();
  }

  /** Measures the faces for the heat map. */
  #measure(): void {
    const values = this.uniforms.uValues.value as DataTexture;
    (values.image.data as Float32Array).set(distortionOf(this.#faces, this.#texture).values);
    values.needsUpdate = true;
  }

  dispose(): void {
    this.#surface.dispose();
    this.#picture?.dispose();
  }
}

/** Returns the triangle of a session that each drawn face is: of all faces with UVs, primitive by primitive; null if the view
 * is simplified. */
function trianglesOf({ analysis, origins }: Shown): Uint32Array | null {
  const { drawn } = analysis;
  if (drawn.count !== drawn.of) return null;
  const isMapped = new Uint8Array(analysis.faces);
  drawn.face.forEach((face, k) => (isMapped[face] = Number(!Number.isNaN(drawn.uvs[6 * k]))));
  const triangle = new Uint32Array(analysis.faces);
  let next = 0;
  for (const { begin, count } of origins.toSorted((a, b) => a.mesh - b.mesh || a.primitive - b.primitive)) {
    if (!isMapped.subarray(begin, begin + count).some(Boolean)) continue;
    for (let face = begin; face < begin + count; face++) triangle[face] = next++;
  }
  return drawn.face.map((face) => triangle[face]!);
}

/** Returns a copy of a picture that begins at the bottom, as UVs do here. */
function upright(picture: Image): Image {
  const image = picture.image as ImageBitmap;
  const canvas = new OffscreenCanvas(image.width, image.height);
  canvas.getContext("2d")!.drawImage(image, 0, 0);
  const copy = new CanvasTexture(canvas);
  copy.wrapS = copy.wrapT = RepeatWrapping;
  copy.colorSpace = "";
  return copy;
}
