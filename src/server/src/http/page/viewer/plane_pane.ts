// The view of the UVs: a plane that can be moved and zoomed.

import { type Object3D, OrthographicCamera, Scene } from "three";
import { move } from "./motion";

const ZOOM_STEP = 0.0016;

/** Camera, scene and controls of the plane. Its unit is the height of the texture. */
export class PlanePane {
  readonly camera = new OrthographicCamera();
  readonly scene = new Scene();
  readonly #changed: () => void;
  /** Center of the view, and its distance to the nearer borders. */
  #middle = [0.5, 0.5];
  #half = 0.55;
  #size = [1, 1];
  /** Set if a person has moved the view since something was fitted into it. */
  isMoved = false;
  readonly #fingers = new Map<number, [number, number]>();

  readonly #panes: HTMLElement[];

  /** Moves the view by the pointer in several panes of the same size. */
  constructor(panes: HTMLElement[], changed: () => void) {
    this.#panes = panes;
    this.#changed = changed;
    for (const pane of panes) this.#listen(pane);
  }

  get element(): HTMLElement {
    return this.#panes[0]!;
  }

  #listen(pane: HTMLElement): void {
    pane.style.touchAction = "none";
    pane.addEventListener("wheel", (event) => this.#wheel(event, pane), { passive: false });
    pane.addEventListener("contextmenu", (event) => event.preventDefault());
    pane.addEventListener("pointerdown", (event) => {
      pane.setPointerCapture(event.pointerId);
      this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
    });
    pane.addEventListener("pointermove", (event) => this.#drag(event, pane));
    for (const end of ["pointerup", "pointercancel"] as const) {
      pane.addEventListener(end, (event) => this.#fingers.delete(event.pointerId));
    }
  }

  show(things: Object3D[]): void {
    this.scene.children = [];
    for (const thing of things) this.scene.add(thing);
  }

  /** Fits a rectangle into the view: least u and v, greatest u and v. */
  frame([u0, v0, u1, v1]: [number, number, number, number]): void {
    this.place = [(u0 + u1) / 2, (v0 + v1) / 2, Math.max(this.#halfFor(u1 - u0, v1 - v0), 1e-6)];
    this.isMoved = false;
  }

  /** Moves so that a rectangle fills the view. */
  fit([u0, v0, u1, v1]: [number, number, number, number]): void {
    const from = this.place;
    const to = [(u0 + u1) / 2, (v0 + v1) / 2, this.#clamped(this.#halfFor(u1 - u0, v1 - v0))];
    move((t) => (this.place = from.map((x, k) => x + (to[k]! - x) * t)));
  }

  #halfFor(width: number, height: number): number {
    const [w, h] = this.#size as [number, number];
    const least = Math.min(w, h);
    return 0.54 * Math.max((width * least) / w, (height * least) / h);
  }

  /** Moves to a place and shows this much of it. */
  flyTo(u: number, v: number, size: number): void {
    const from = this.place as [number, number, number];
    const to = [u, v, Math.min(Math.max(size * 6, 0.06), 0.55)];
    move((t) => (this.place = from.map((x, k) => x + (to[k]! - x) * t)));
  }

  /** Center of the view, and its distance to the nearer borders. */
  get place(): number[] {
    return [...this.#middle, this.#half];
  }

  set place([u = 0.5, v = 0.5, half = 0.55]: number[]) {
    this.#middle = [u, v];
    this.#half = half;
    this.isMoved = true;
    this.#apply();
  }

  /** Moves the view by shares of what it shows, and zooms around its middle. */
  nudge(right: number, up: number, factor = 1): void {
    this.place = [this.#middle[0]! + 2 * right * this.#half, this.#middle[1]! + 2 * up * this.#half, this.#limited(factor)];
  }

  resize(width: number, height: number): void {
    this.#size = [Math.max(width, 1), Math.max(height, 1)];
    this.#apply();
  }

  #apply(): void {
    const [w, h] = this.#size as [number, number];
    const unit = this.#half / Math.min(w, h);
    Object.assign(this.camera, { left: -w * unit, right: w * unit, top: h * unit, bottom: -h * unit, near: -1, far: 1 });
    this.camera.position.set(this.#middle[0]!, this.#middle[1]!, 0);
    this.camera.updateProjectionMatrix();
    this.#changed();
  }

  /** Converts a position on the page to the plane. */
  at(x: number, y: number): [number, number] {
    const box = this.element.getBoundingClientRect();
    return [this.#middle[0]! + (x - box.left - box.width / 2) * this.#unit, this.#middle[1]! - (y - box.top - box.height / 2) * this.#unit];
  }

  /** Units of the plane per pixel. */
  get #unit(): number {
    return (2 * this.#half) / Math.min(...this.#size);
  }

  #wheel(event: WheelEvent, pane: HTMLElement): void {
    event.preventDefault();
    this.#zoom(Math.exp(event.deltaY * ZOOM_STEP * (event.deltaMode ? 24 : 1)), [event.clientX, event.clientY], pane);
  }

  /** Zooms around the position of the pointer. */
  #zoom(factor: number, [x, y]: [number, number], pane: HTMLElement): void {
    const box = pane.getBoundingClientRect();
    const [dx, dy] = [x - box.left - box.width / 2, y - box.top - box.height / 2];
    const half = this.#limited(factor);
    const change = this.#unit * (1 - half / this.#half);
    this.place = [this.#middle[0]! + dx * change, this.#middle[1]! - dy * change, half];
  }

  /** Returns a multiple of the distance to the nearer borders, within limits. */
  #limited(factor: number): number {
    return this.#clamped(this.#half * factor);
  }

  #clamped(half: number): number {
    return Math.min(Math.max(half, 1e-4), 20);
  }

  #drag(event: PointerEvent, pane: HTMLElement): void {
    const last = this.#fingers.get(event.pointerId);
    if (!last) return;
    const others = [...this.#fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
    const share = 1 / (others.length + 1);
    const [dx, dy] = [(event.clientX - last[0]) * share, (event.clientY - last[1]) * share];
    this.place = [this.#middle[0]! - dx * this.#unit, this.#middle[1]! + dy * this.#unit, this.#half];
    const other = others[0];
    if (!other) return;
    const before = Math.hypot(last[0] - other[0], last[1] - other[1]);
    const after = Math.hypot(event.clientX - other[0], event.clientY - other[1]);
    if (0 < before && 0 < after) this.#zoom(before / after, [(event.clientX + other[0]) / 2, (event.clientY + other[1]) / 2], pane);
  }
}
