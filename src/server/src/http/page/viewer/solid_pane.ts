// The view of the surface: a camera that orbits it.

import { MathUtils, type Object3D, PerspectiveCamera, Scene, Sphere, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { isStill, move } from "./motion";
import { type Buttons, buttonsOf } from "./navigation";

/** Initial direction of the camera, in front and a little above: the front of glTF is +z. */
const FRONT = [0.55, 0.35, 1] as const;

/** Half the angle of view across the narrower side, in radians: a longer lens than usual, with little perspective. */
const HALF_VIEW = MathUtils.degToRad(16);

/** Speed of turning, and the time of one turn: `OrbitControls` take 60 s at a speed of 1. */
const SPEED = 1.4;
const TURNING_MS = 60_000 / SPEED;

/** Camera, scene and controls of the surface. */
export class SolidPane {
  readonly camera = new PerspectiveCamera(2 * MathUtils.radToDeg(HALF_VIEW), 1, 0.01, 100);
  readonly scene = new Scene();
  readonly #all: OrbitControls[];
  /** Those of the first pane. */
  readonly #controls: OrbitControls;
  #around = new Sphere(new Vector3(), 1);
  #rest = 0;
  /** Set if a person has moved the camera since everything was fitted into the view. */
  isMoved = false;
  /** Returns the actions of the buttons for a press of one. */
  buttons: (event: PointerEvent) => Buttons = (event) => buttonsOf("page", event);

  /** Moves the camera by the pointer in several panes of the same size. */
  constructor(panes: HTMLElement[], changed: () => void) {
    const all = panes.map((pane) => new OrbitControls(this.camera, pane));
    this.#all = all;
    this.#controls = all[0]!;
    this.#controls.autoRotateSpeed = SPEED;
    for (const [k, controls] of all.entries()) {
      controls.zoomToCursor = true;
      // Choose the actions before the controls see the press.
      panes[k]!.addEventListener("pointerdown", (event) => (controls.mouseButtons = this.buttons(event)), { capture: true });
      controls.addEventListener("change", () => {
        // All look at the same place.
        for (const other of all) other.target.copy(controls.target);
        changed();
      });
      controls.addEventListener("start", () => {
        this.turn(false);
        this.isMoved = true;
        controls.target.copy(this.#controls.target);
      });
    }
  }

  /** Shows these objects and nothing else. */
  show(things: Object3D[], around: Sphere | null): void {
    this.scene.children = [];
    for (const thing of things) this.scene.add(thing);
    if (around) this.#around = around.clone();
  }

  /** Fits everything into the view, from the front and a little above by default. */
  frame(from: readonly [number, number, number] = FRONT): void {
    const { center, radius } = this.#around;
    this.isMoved = false;
    this.#look(center.clone().add(new Vector3(...from).setLength(radius / Math.sin(HALF_VIEW))), center);
  }

  /** Fits a part into the view, seen from where the camera is. */
  fit({ center, radius }: Sphere): void {
    this.turn(false);
    this.isMoved = true;
    const [from, target] = [this.camera.position.clone(), this.#controls.target.clone()];
    const arm = from.clone().sub(target).setLength(Math.max(radius / Math.sin(HALF_VIEW), this.#controls.minDistance));
    move((t) => this.#look(from.clone().lerp(center.clone().add(arm), t), target.clone().lerp(center, t)));
  }

  /** Flies to a place, seen from a direction. */
  flyTo(place: Vector3, direction: Vector3, size: number): void {
    this.turn(false);
    this.isMoved = true;
    const distance = Math.max(size * 9, this.#around.radius * 0.55);
    const [from, target] = [this.camera.position.clone(), this.#controls.target.clone()];
    const to = place.clone().add(direction.clone().normalize().multiplyScalar(distance));
    move((t) => this.#look(from.clone().lerp(to, t), target.clone().lerp(place, t)));
  }

  /** Turns the camera around its target by degrees to the right and upward, short of the poles, and moves it to a multiple
   * of its distance. */
  orbit(right: number, up: number, farther = 1): void {
    this.turn(false);
    this.isMoved = true;
    const target = this.#controls.target.clone();
    const arm = new Spherical().setFromVector3(this.camera.position.clone().sub(target));
    arm.theta += MathUtils.degToRad(right);
    arm.phi -= MathUtils.degToRad(up);
    arm.radius *= farther;
    this.#look(target.clone().add(new Vector3().setFromSpherical(arm.makeSafe())), target);
  }

  /** Looks at the same target from another direction, as far away as before. */
  lookFrom(direction: readonly [number, number, number]): void {
    this.turn(false);
    this.isMoved = true;
    const target = this.#controls.target.clone();
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(target));
    const to = new Spherical().setFromVector3(new Vector3(...direction));
    const turn = MathUtils.euclideanModulo(to.theta - from.theta + Math.PI, 2 * Math.PI) - Math.PI;
    move((t) => {
      const now = new Spherical(from.radius, MathUtils.lerp(from.phi, to.phi, t), from.theta + turn * t).makeSafe();
      this.#look(target.clone().add(new Vector3().setFromSpherical(now)), target);
    });
  }

  /** Turns slowly until a person takes over, but for one full turn at most. */
  turn(isTurning: boolean): void {
    this.#controls.autoRotate = isTurning && !isStill();
    clearTimeout(this.#rest);
    if (this.#controls.autoRotate) this.#rest = window.setTimeout(() => this.turn(false), TURNING_MS);
  }

  get isTurning(): boolean {
    return this.#controls.autoRotate;
  }

  /** Updates the camera. Returns whether it moves by itself. */
  update(): boolean {
    return this.#controls.update() || this.#controls.autoRotate;
  }

  /** Takes another size: what filled the narrower side still does. */
  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(height, 1);
    this.camera.fov = 2 * MathUtils.radToDeg(Math.atan(Math.tan(HALF_VIEW) / Math.min(this.camera.aspect, 1)));
    this.camera.updateProjectionMatrix();
  }

  /** Position of the camera and its target: six numbers. */
  get place(): number[] {
    return [...this.camera.position.toArray(), ...this.#controls.target.toArray()];
  }

  set place(numbers: number[]) {
    this.isMoved = true;
    this.#look(new Vector3().fromArray(numbers), new Vector3().fromArray(numbers, 3));
  }

  #look(from: Vector3, at: Vector3): void {
    this.camera.position.copy(from);
    this.#controls.target.copy(at);
    this.camera.near = this.#around.radius / 500;
    this.camera.far = this.#around.radius * 100;
    // Stay well between the planes that clip.
    for (const controls of this.#all) Object.assign(controls, { minDistance: 2 * this.camera.near, maxDistance: this.camera.far / 2 });
    this.camera.updateProjectionMatrix();
    this.#controls.update();
  }
}
