// A texture as a baker fills it: each chart in its color, and continued over the padding around it. Its mip levels show from
// which distance on neighbors and empty texels are mixed into a chart.

import { GLSL3, LinearFilter, LinearMipmapLinearFilter, Mesh, NoBlending, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, type WebGLRenderer, WebGLRenderTarget } from "three";
import type { Texture } from "../analysis/soup";
import type { Uniforms } from "./look";
import type { Model } from "./model";
import { GUTTER_FACE_FRAGMENT, GUTTER_FACE_VERTEX, GUTTER_FRAGMENT, GUTTER_VERTEX, TEXELS_FRAGMENT, TEXELS_VERTEX } from "./shaders";
import { pagesOf } from "./sheet";

/** Greatest side of the picture in texels, which takes 22 MB with its levels. Finer levels of larger textures look like the
 * finest one of the picture. */
const MOST = 2048;

/** The filled texture of an atlas. */
export interface Filled {
  model: Model;
  atlas: number;
  texture: Texture;
  /** Padding in texels of the texture. */
  padding: number;
  /** The shown level. */
  mip: number;
}

/** Returns the greatest mip level of a texture. */
export function levelsOf({ width, height }: Texture): number {
  return Math.floor(Math.log2(Math.max(width, height)));
}

/** The texture on the GPU. It is filled again only if it changes. */
export class Gutters {
  #key = "";
  #target: WebGLRenderTarget | null = null;
  #picture: Mesh | null = null;

  /** Shows a level on the surface. Returns the picture for the background of the UVs. */
  show(renderer: WebGLRenderer, filled: Filled, shared: Uniforms): Mesh {
    const { model, atlas, texture, padding, mip } = filled;
    const pages = pagesOf(model.analysis.atlases[atlas]!.bounds);
    const scale = Math.min(1, MOST / (texture.width * pages), MOST / texture.height);
    const key = [model.surface.id, atlas, padding, texture.width, texture.height].join();
    if (key !== this.#key || !this.#target || !this.#picture) {
      this.dispose();
      this.#key = key;
      const [width, height] = [texture.width * pages, texture.height].map((side) => Math.max(1, Math.round(side * scale))) as [number, number];
      this.#target = new WebGLRenderTarget(width, height, { generateMipmaps: true, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter });
      fill(renderer, this.#target, model, { atlas, pages, radius: padding * scale }, shared);
      this.#picture = pictureOf(pages, model.aspect, shared);
    }
    shared.uTexels.value = this.#target.texture;
    shared.uPages.value = pages;
    shared.uLevel.value = Math.max(0, Math.round(mip + Math.log2(scale)));
    return this.#picture;
  }

  dispose(): void {
    this.#key = "";
    this.#target?.dispose();
    this.#picture?.geometry.dispose();
    (this.#picture?.material as ShaderMaterial | undefined)?.dispose();
    this.#target = this.#picture = null;
  }
}

/** Draws faces and their continuation: where several charts reach, the nearest one. */
function fill(renderer: WebGLRenderer, target: WebGLRenderTarget, model: Model, { atlas, pages, radius }: { atlas: number; pages: number; radius: number }, shared: Uniforms): void {
  const uniforms = {
    uIds: shared.uIds, uValues: shared.uValues, uAspect: shared.uAspect, uAtlas: { value: atlas }, uPages: { value: pages }, uRadius: { value: radius },
    uSize: { value: [target.width, target.height] },
  };
  const material = (vertexShader: string, fragmentShader: string) => new ShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: 2, blending: NoBlending });
  const { plane } = model.surface.layers;
  const meshes = [new Mesh(plane.surface.geometry, material(GUTTER_FACE_VERTEX, GUTTER_FACE_FRAGMENT)), new Mesh(plane.borders.geometry, material(GUTTER_VERTEX, GUTTER_FRAGMENT))];
  const scene = new Scene();
  for (const mesh of meshes) {
    mesh.frustumCulled = false;
    scene.add(mesh);
  }
  renderer.setRenderTarget(target);
  // Texels that no chart reaches are black.
  renderer.setClearColor(0, 1);
  renderer.clear();
  renderer.render(scene, new OrthographicCamera());
  renderer.setRenderTarget(null);
  for (const { material } of meshes) material.dispose();
}

/** Creates the background of the UVs, which shows the texels of the level one by one. */
function pictureOf(pages: number, aspect: number, { uTexels, uLevel }: Uniforms): Mesh {
  const material = new ShaderMaterial({ glslVersion: GLSL3, vertexShader: TEXELS_VERTEX, fragmentShader: TEXELS_FRAGMENT, uniforms: { uTexels, uLevel }, depthTest: false, depthWrite: false });
  const picture = new Mesh(new PlaneGeometry(pages * aspect, 1), material);
  picture.position.set((pages * aspect) / 2, 0.5, 0);
  picture.renderOrder = -2;
  return picture;
}
