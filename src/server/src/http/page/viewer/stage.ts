// Both views on one canvas, with one set of buffers; drawn only when something changed.

import { type Camera, Color, DirectionalLight, HemisphereLight, type Light, type Material, type Mesh, NeutralToneMapping, PMREMGenerator, Scene, Vector3, WebGLRenderer, type WebGLRenderTarget } from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";
import { type Uniforms, uniforms } from "./look";
import type { Model } from "./model";
import { Picker } from "./picking";
import { PlanePane } from "./plane_pane";
import { SolidPane } from "./solid_pane";
import type { View } from "./surface";

/** The element under the pointer. */
export interface Hit {
  view: View;
  face: number;
  /** An index of `Analysis.borders`, or -1. */
  border: number;
}

/** DOM elements that a stage needs. */
export interface Places {
  canvas: HTMLCanvasElement;
  solid: HTMLElement;
  plane: HTMLElement;
  /** The panes of another file, which is seen beside with the same cameras. */
  beside: Record<View, HTMLElement>;
}

/** Intensities of lights: of sky and key without surroundings, and of room, sky and key together. Found by looking: a white,
 * rough model is nowhere burnt out, and polished metal stands out on the dark stage. The sky lights materials that reflect
 * no surroundings, such as those of OBJ files. */
const PLAIN = { sky: 2, key: 2 };
const SURROUNDED = { room: 0.6, sky: 0.5, key: 0.8 };
/** Side of the faces of the surroundings, in texels. The default of 256 takes a software renderer seconds, for reflections
 * of a few soft lamps. */
const ROOM_TEXELS = 64;

/** Draws both views. Its constructor throws without WebGL. */
export class Stage {
  readonly uniforms: Uniforms = uniforms();
  readonly solid: SolidPane;
  readonly plane: PlanePane;
  readonly renderer: WebGLRenderer;
  /** Contents of the panes beside. */
  readonly beside = { solid: new Scene(), plane: new Scene() };
  readonly #picker = new Picker();
  readonly #places: Places;
  #isAsked = false;
  /** Callback before each frame is drawn. */
  onFrame: () => void = () => {};
  background = "#ffffff";
  /** Milliseconds of our JavaScript in the latest frame, and the number of frames. */
  readonly figures = { milliseconds: 0, frames: 0 };

  constructor(places: Places) {
    this.#places = places;
    this.renderer = new WebGLRenderer({ canvas: places.canvas, antialias: true, alpha: false, powerPreference: "high-performance" });
    // Keep colors as they are and compress only highlights, as the Khronos viewer does.
    this.renderer.toneMapping = NeutralToneMapping;
    this.renderer.autoClear = false;
    this.renderer.info.autoReset = false;
    this.solid = new SolidPane([places.solid, places.beside.solid], () => this.redraw());
    this.plane = new PlanePane([places.plane, places.beside.plane], () => this.redraw());
    new ResizeObserver(() => this.resize()).observe(places.canvas.parentElement!);
    this.resize();
  }

  #surroundings: WebGLRenderTarget | null = null;

  /** Returns new lights for the materials of documents, and surrounds them with a neutral room, which metals reflect. */
  light(): Light[] {
    if (!this.#surroundings) {
      const [generator, room] = [new PMREMGenerator(this.renderer), new RoomEnvironment()];
      this.#surroundings = generator.fromScene(room, 0.04, 0.1, 100, { size: ROOM_TEXELS });
      for (const scene of [this.solid.scene, this.beside.solid]) {
        scene.environment = this.#surroundings.texture;
        scene.environmentIntensity = SURROUNDED.room;
      }
      room.dispose();
      generator.dispose();
    }
    return lights(SURROUNDED);
  }

  /** Draws again after the graphics device was lost, with new surroundings. */
  restore(): void {
    if (this.#surroundings) {
      this.#surroundings.dispose();
      this.#surroundings = null;
      this.light();
    }
    this.redraw();
  }

  /** Requests another frame. */
  redraw(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame(() => {
      this.#isAsked = false;
      this.#frame();
    });
  }

  resize(): void {
    const box = this.#places.canvas.parentElement!.getBoundingClientRect();
    // A hidden view has no size, and no camera could see it.
    if (box.width < 1 || box.height < 1) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(box.width, box.height, false);
    for (const view of ["solid", "plane"] as const) {
      const { width, height } = this.#places[view].getBoundingClientRect();
      if (width < 1 || height < 1) continue;
      this[view].resize(width, height);
    }
    this.redraw();
  }

  #frame(): void {
    const begin = performance.now();
    if (this.solid.update()) this.redraw();
    this.onFrame();
    this.renderer.info.reset();
    this.renderer.setScissorTest(true);
    for (const view of ["solid", "plane"] as const) {
      this.#draw(this.#places[view], this[view].scene, this[view].camera);
      this.#draw(this.#places.beside[view], this.beside[view], this[view].camera);
    }
    this.figures.milliseconds = performance.now() - begin;
    this.figures.frames += 1;
  }

  #draw(pane: HTMLElement, scene: Scene, camera: Camera): void {
    const { left, bottom, width, height } = this.#box(pane);
    if (width < 1 || height < 1) return;
    this.uniforms.uViewport.value.set(width * this.renderer.getPixelRatio(), height * this.renderer.getPixelRatio());
    this.uniforms.uPixelRatio.value = this.renderer.getPixelRatio();
    this.renderer.setViewport(left, bottom, width, height);
    this.renderer.setScissor(left, bottom, width, height);
    this.renderer.setClearColor(new Color(this.background), 1);
    this.renderer.clear();
    this.renderer.render(scene, camera);
  }

  /** Returns the rectangle of a pane on the canvas, from below. */
  #box(pane: HTMLElement) {
    const canvas = this.#places.canvas.getBoundingClientRect();
    const box = pane.getBoundingClientRect();
    return { left: box.left - canvas.left, bottom: canvas.bottom - box.bottom, width: box.width, height: box.height };
  }

  /** Returns the element at a place of a view; with `borders`, also the border of a chart. */
  pick(model: Model, view: View, x: number, y: number, borders: boolean): Hit | null {
    const { width, height } = this.#places[view].getBoundingClientRect();
    const layer = model.surface.layers[view];
    // Draw a single pixel.
    this.uniforms.uViewport.value.set(1, 1);
    this.uniforms.uPixelRatio.value = 1;
    this.renderer.setScissorTest(false);
    const at = (meshes: typeof layer.surface[]) => this.#picker.pick(this.renderer, meshes, this[view].camera, [x, y], [width, height]);
    const drawn = at([layer.pickSurface]);
    const border = borders ? this.#hiding(layer.pickSurface, () => at([layer.pickSurface, layer.pickBorders])) : -1;
    const { face } = model.analysis.drawn;
    if (drawn < 0 && border < 0) return null;
    return { view, border, face: 0 <= drawn ? (face[drawn] ?? -1) : (model.analysis.borders.face[border] ?? -1) };
  }

  /** Lets a mesh only occlude while something is picked. */
  #hiding<T>({ material }: Mesh, pick: () => T): T {
    const one = material as Material;
    one.colorWrite = false;
    try {
      return pick();
    } finally {
      one.colorWrite = true;
    }
  }

  /** Returns the position of a point of the scene or of the plane on the page. */
  project(view: View, point: Vector3): [number, number] {
    const { left, top, width, height } = this.#places[view].getBoundingClientRect();
    this[view].camera.updateMatrixWorld();
    const { x, y } = point.clone().project(this[view].camera);
    return [left + ((x + 1) / 2) * width, top + ((1 - y) / 2) * height];
  }
}

/** Creates the light of a sky, and a key light from above and the right. */
export function lights({ sky, key }: { sky: number; key: number } = PLAIN): Light[] {
  const sun = new DirectionalLight(0xffffff, key);
  sun.position.set(1, 2, 3);
  return [new HemisphereLight(0xffffff, 0x8a8f98, sky), sun];
}
