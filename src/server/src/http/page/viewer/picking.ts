// Picking: draws one texel with ids instead of colors, and reads it.

import { type Camera, type Mesh, type OrthographicCamera, type PerspectiveCamera, Scene, WebGLRenderTarget, type WebGLRenderer } from "three";

type Movable = PerspectiveCamera | OrthographicCamera;

/** Draws and reads the texel under the pointer. */
export class Picker {
  readonly #target = new WebGLRenderTarget(1, 1);
  readonly #scene = new Scene();

  /** Returns the id at a place of a view of this size, or -1. Later meshes cover earlier ones. */
  pick(renderer: WebGLRenderer, meshes: Mesh[], camera: Camera, [x, y]: [number, number], [width, height]: [number, number]): number {
    const movable = camera as Movable;
    movable.setViewOffset(width, height, Math.floor(x), Math.floor(y), 1, 1);
    this.#scene.children = meshes;
    renderer.setRenderTarget(this.#target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(this.#scene, camera);
    const [r, g, b, a] = this.#read(renderer);
    renderer.setRenderTarget(null);
    movable.clearViewOffset();
    this.#scene.children = [];
    return r + 256 * g + 65536 * b + 16777216 * a - 1;
  }

  #read(renderer: WebGLRenderer): [number, number, number, number] {
    const texel = new Uint8Array(4);
    renderer.readRenderTargetPixels(this.#target, 0, 0, 1, 1, texel);
    return [texel[0]!, texel[1]!, texel[2]!, texel[3]!];
  }
}
