// Drawing of a pulled mesh: the mesh in the plane or in space, its wire, and picking of places on it.

import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, HemisphereLight, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial,
  MeshStandardMaterial, Raycaster, SRGBColorSpace, type Texture, TextureLoader, Vector2, Vector3, WebGLRenderer,
} from "three";
import type { LiveMesh } from "../live/decode";
import { PlanePane } from "../viewer/plane_pane";
import { SolidPane } from "../viewer/solid_pane";
import { color } from "../viewer/theme_color";
import type { Texture as Page } from "../analysis/soup";
import { sheetOf } from "../viewer/sheet";
import { Beside, type Shown } from "./beside";
import { type Faults, Islands } from "./islands";
import { Seen } from "./seen";

/** Maximum number of triangles whose sides are drawn. Beyond it, lines would cover the mesh and slow down the
 * frames. */
const MOST_WIRED = 60_000;

/** Settings of drawing a pulled mesh. */
export interface Look {
  /** Height from which y is counted down; null if it points up. */
  down: number | null;
  picture: Blob | null;
  /** Set if UVs are pulled, whose pages are drawn below. */
  isMap: boolean;
  /** What the page shows of the file whose UVs are pulled. */
  shown: Shown | null;
}

/** A place on the mesh: at rest, and now. */
export interface Touched { at: number[]; to: number[] }

/** The view of a session. Its constructor throws without WebGL. */
export class PullScene {
  readonly #renderer: WebGLRenderer;
  readonly #plane: PlanePane;
  readonly #solid: SolidPane;
  #seen: Seen | null = null;
  #look: Look = { down: null, picture: null, isMap: false, shown: null };
  #islands: Islands | null = null;
  /** The surface of pulled UVs, which is seen beside them. */
  beside: Beside | null = null;
  #body: Mesh | null = null;
  #things: (Mesh | LineSegments)[] = [];
  readonly #wrong = new BufferGeometry();
  readonly #near = new BufferGeometry();
  #isAsked = false;
  /** Number of times that the vertices were moved. */
  step = 0;
  /** Callback after each frame is drawn. */
  drawn: () => void = () => {};

  constructor(canvas: HTMLCanvasElement, readonly places: { plane: HTMLElement; solid: HTMLElement }) {
    this.#renderer = new WebGLRenderer({ canvas, antialias: true });
    this.#plane = new PlanePane([places.plane], () => this.redraw());
    this.#solid = new SolidPane([places.solid], () => this.redraw());
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement!);
  }

  get isPlanar(): boolean {
    return this.#seen?.mesh.dim !== 3;
  }

  /** The element that receives drags. */
  get pane(): HTMLElement {
    return this.isPlanar ? this.places.plane : this.places.solid;
  }

  async show(mesh: LiveMesh, look: Look): Promise<void> {
    this.clear();
    this.#look = look;
    this.#seen = new Seen(mesh, look.down);
    if (look.isMap) this.#islands = new Islands(mesh.triangles, this.#seen.uvs());
    if (look.isMap) this.beside = Beside.of(look.shown, this.#seen.uvs());
    this.places.plane.hidden = mesh.dim === 3;
    this.places.solid.hidden = mesh.dim === 2 && !this.beside;
    this.places.solid.setAttribute("aria-label", this.beside ? "Surface of the UVs: drag to turn, wheel to zoom" : this.places.plane.getAttribute("aria-label")!);
    this.places.plane.parentElement!.classList.toggle("beside", this.beside !== null);
    const texture = look.picture ? await textureOf(look.picture) : null;
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.#seen.attribute);
    geometry.setIndex(new BufferAttribute(mesh.triangles, 1));
    if (texture) geometry.setAttribute("uv", new BufferAttribute(pictureUvs(mesh), 2));
    this.#body = new Mesh(geometry, this.#material(texture));
    this.#body.frustumCulled = false;
    this.#things = [...(look.isMap ? sheetOf(1, 1, { paper: color("--sheet"), line: color("--sheet-line"), border: color("--sheet-border") }) : []), this.#body];
    if (!texture && mesh.triangles.length <= 3 * MOST_WIRED) this.#things.push(this.#wire(mesh));
    const key = new DirectionalLight(0xffffff, 2);
    key.position.set(1, 2, 3);
    if (look.isMap) this.#things.push(this.#marks(), this.#gaps());
    const lights = [new HemisphereLight(0xffffff, 0x8a8f98, 2), key];
    geometry.computeBoundingSphere();
    if (mesh.dim === 3) this.#solid.show([...this.#things, ...lights], geometry.boundingSphere);
    else this.#plane.show(this.#things);
    if (this.beside) this.#solid.show(this.beside.things, this.beside.sphere);
    this.#resize();
    this.frame();
  }

  #material(map: Texture | null): MeshBasicMaterial | MeshStandardMaterial {
    const offset = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1, side: DoubleSide } as const;
    if (this.isPlanar) return new MeshBasicMaterial({ ...(map ? { map } : { color: color("--pulled") }), depthTest: false, depthWrite: false, toneMapped: false, side: DoubleSide });
    return new MeshStandardMaterial({ color: color("--pulled"), flatShading: true, roughness: 0.8, ...offset });
  }

  /** Creates the lines of borders that are too near to others. */
  #gaps(): LineSegments {
    this.#near.setAttribute("position", this.#seen!.attribute);
    this.#near.setIndex([]);
    const gaps = new LineSegments(this.#near, new LineBasicMaterial({ color: color("--alarm"), depthTest: false, toneMapped: false }));
    gaps.frustumCulled = false;
    gaps.renderOrder = 2;
    return gaps;
  }

  /** Creates the mesh of faces that overlap others or leave the pages. */
  #marks(): Mesh {
    this.#wrong.setAttribute("position", this.#seen!.attribute);
    this.#wrong.setIndex([]);
    const marks = new Mesh(this.#wrong, new MeshBasicMaterial({ color: color("--alarm"), transparent: true, opacity: 0.75, depthTest: false, depthWrite: false, toneMapped: false, side: DoubleSide }));
    marks.frustumCulled = false;
    return marks;
  }

  #wire(mesh: LiveMesh): LineSegments {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.#seen!.attribute);
    geometry.setIndex(new BufferAttribute(edgesOf(mesh.triangles), 1));
    const wire = new LineSegments(geometry, new LineBasicMaterial({ color: color("--pulled-wire"), transparent: true, opacity: 0.55, depthTest: mesh.dim === 3, toneMapped: false }));
    wire.frustumCulled = false;
    wire.renderOrder = 1;
    return wire;
  }

  /** Moves the vertices to their current places. */
  move(positions: Float32Array | Float64Array): void {
    this.#seen?.move(positions);
    if (this.beside) this.beside.move(this.#seen!.uvs());
    this.step += 1;
    this.redraw();
  }

  /** Draws the surface beside with another fill. */
  refill(): void {
    this.beside?.move(this.#seen!.uvs());
    this.redraw();
  }

  /** Set if UVs are pulled. */
  get isMap(): boolean {
    return this.#look.isMap && this.#seen !== null;
  }

  /** Finds the defects of UVs and marks them in red: faces that overlap or leave the pages that they were on at rest, and
   * borders that are nearer to another island than the padding. */
  faults(): Faults {
    const { triangles } = this.#seen!.mesh;
    const { faults, marked } = this.#islands!.judge(this.#seen!.uvs(), this.#page);
    this.#wrong.setIndex([...marked.faces].flatMap((k) => [...triangles.subarray(3 * k, 3 * k + 3)]));
    this.#near.setIndex(marked.borders.flatMap((edge) => [triangles[edge]!, triangles[edge % 3 === 2 ? edge - 2 : edge + 1]!]));
    this.redraw();
    return faults;
  }

  /** The texture with its padding, known if the page shows these UVs. */
  get #page(): Page | null {
    return this.beside ? this.#look.shown!.texture : null;
  }

  clear(): void {
    for (const thing of this.#things) {
      thing.geometry.dispose();
      for (const material of [thing.material].flat()) material.dispose();
    }
    this.#things = [];
    this.#body = this.#seen = this.#islands = null;
    this.beside?.dispose();
    this.beside = null;
    this.#plane.show([]);
    this.#solid.show([], null);
    this.redraw();
  }

  /** Fits everything into the view. */
  frame(): void {
    if (!this.#seen) return;
    if (!this.isPlanar || this.beside) this.#solid.frame();
    if (!this.isPlanar) return;
    const [u0, v0, u1, v1] = this.#look.isMap ? [0, 0, 1, 1] : this.#seen.box();
    const [du, dv] = [0.15 * (u1 - u0), 0.15 * (v1 - v0)];
    this.#plane.frame([u0 - du, v0 - dv, u1 + du, v1 + dv]);
  }

  redraw(): void {
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame(() => {
      this.#isAsked = false;
      this.#draw();
    });
  }

  #draw(): void {
    const isSolid = !this.isPlanar || this.beside !== null;
    if (isSolid && this.#solid.update()) this.redraw();
    this.#renderer.setClearColor(new Color(color("--stage")), 1);
    this.#renderer.setScissorTest(false);
    this.#renderer.clear();
    if (this.#seen && this.isPlanar) this.#drawIn(this.places.plane, this.#plane);
    if (this.#seen && isSolid) this.#drawIn(this.places.solid, this.#solid);
    this.drawn();
  }

  #drawIn(place: HTMLElement, { scene, camera }: PlanePane | SolidPane): void {
    const canvas = this.#renderer.domElement.getBoundingClientRect();
    const { left, bottom, width, height } = place.getBoundingClientRect();
    if (width < 1 || height < 1) return;
    const box = [left - canvas.left, canvas.bottom - bottom, width, height] as const;
    const ratio = this.#renderer.getPixelRatio();
    this.beside?.uniforms.uViewport.value.set(width * ratio, height * ratio);
    if (this.beside) this.beside.uniforms.uPixelRatio.value = ratio;
    this.#renderer.setViewport(...box);
    this.#renderer.setScissor(...box);
    this.#renderer.setScissorTest(true);
    this.#renderer.render(scene, camera);
  }

  #resize(): void {
    const { width, height } = this.#renderer.domElement.parentElement!.getBoundingClientRect();
    if (width < 1 || height < 1) return;
    this.#renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.#renderer.setSize(width, height, false);
    for (const [pane, place] of [[this.#plane, this.places.plane], [this.#solid, this.places.solid]] as const) {
      const box = place.getBoundingClientRect();
      pane.resize(box.width, box.height);
    }
    this.redraw();
  }

  get #camera() {
    const { camera } = this.isPlanar ? this.#plane : this.#solid;
    camera.updateMatrixWorld();
    return camera;
  }

  /** Returns the position of a place of the mesh, in pixels of the view. */
  project(place: number[]): [number, number] {
    const { width, height } = this.pane.getBoundingClientRect();
    const { x, y } = this.#seen!.outward(place).project(this.#camera);
    return [((x + 1) / 2) * width, ((1 - y) / 2) * height];
  }

  /** Returns the place at a pixel, at the depth of another place. */
  placeAt([x, y]: [number, number], depthOf: number[]): number[] {
    const { z } = this.#seen!.outward(depthOf).project(this.#camera);
    return this.#seen!.inward(new Vector3(...this.#device(x, y), z).unproject(this.#camera));
  }

  /** Returns the place of the mesh at a pixel. */
  touch([x, y]: [number, number]): Touched | null {
    if (!this.#body || !this.#seen) return null;
    if (this.isPlanar) return this.#seen.touchPlane(this.placeAt([x, y], [0, 0]));
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(...this.#device(x, y)), this.#camera);
    this.#body.geometry.computeBoundingSphere();
    const [hit] = ray.intersectObject(this.#body, false);
    return hit?.faceIndex === undefined || hit.faceIndex === null ? null : this.#seen.touchFace(hit.faceIndex, hit.point);
  }

  /** Direction towards the viewer, in the mesh's coordinates. */
  get axis(): number[] | null {
    if (this.isPlanar) return null;
    const toward = new Vector3(0, 0, 1).transformDirection(this.#camera.matrixWorld);
    return toward.toArray();
  }

  /** 1 if counter-clockwise in the mesh's coordinates is counter-clockwise on the screen, else -1. */
  get handedness(): number {
    return this.isPlanar && this.#look.down !== null ? -1 : 1;
  }

  /** Size of the mesh at rest. */
  get extent(): number {
    return this.#seen?.extent ?? 1;
  }

  #device(x: number, y: number): [number, number] {
    const { width, height } = this.pane.getBoundingClientRect();
    return [(x / width) * 2 - 1, 1 - (y / height) * 2];
  }
}

function pictureUvs({ rest, picture: [columns, rows] }: LiveMesh): Float32Array {
  return Float32Array.from(rest, (x, k) => (k % 2 ? 1 - x / rows : x / columns));
}

async function textureOf(picture: Blob): Promise<Texture> {
  const url = URL.createObjectURL(picture);
  const texture = await new TextureLoader().loadAsync(url).finally(() => URL.revokeObjectURL(url));
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

/** Returns the sides of triangles, each once. */
function edgesOf(triangles: Uint32Array): Uint32Array {
  const seen = new Set<number>();
  const edges: number[] = [];
  for (let k = 0; k < triangles.length; k += 3) {
    for (const [i, j] of [[0, 1], [1, 2], [2, 0]] as const) {
      const [a, b] = [triangles[k + i]!, triangles[k + j]!];
      const key = Math.min(a, b) * 0x4000000 + Math.max(a, b);
      if (seen.has(key)) continue;
      seen.add(key);
      edges.push(a, b);
    }
  }
  return Uint32Array.from(edges);
}
