// Pointer gestures in the view of a session: holding, dragging, and moving grips together.

import { type Gesture, stretched, swept } from "../viewer/gesture";
import { type Grip, type Grips, Motion } from "./grips";
import type { PullScene, Touched } from "./scene";

/** Distance in pixels within which a grip is under the pointer. */
const NEAR = 12;
/** Maximum movement in pixels of a press that is not a drag. */
const STILL = 3;

/** Receiver of gestures. */
export interface Doer {
  /** Called before the grips are moved. */
  begin(): void;
  hold(touched: Touched): Grip;
  /** The grips have moved; `isTurned` if more than their targets changed. */
  moved(grips: Grip[], isTurned: boolean): void;
  cancel(): void;
  refresh(): void;
}

/** Follows the pointer. */
export class Pointer {
  #motion: Motion | null = null;
  /** Start of a gesture or a drag, and the current position of the pointer. */
  #from: [number, number] = [0, 0];
  #at: [number, number] = [0, 0];
  #dragged = false;
  /** Set while a button is down; otherwise a key began the gesture. */
  #isDown = false;

  constructor(readonly scene: PullScene, readonly grips: Grips, readonly doer: Doer) {
    for (const pane of [scene.places.plane, scene.places.solid]) {
      pane.addEventListener("pointerdown", (event) => this.#down(event, pane), { capture: true });
      pane.addEventListener("pointermove", (event) => this.#move(event, pane), { capture: true });
      pane.addEventListener("pointerup", (event) => this.#up(event), { capture: true });
    }
  }

  get gesture(): Gesture | null {
    return this.#motion?.gesture ?? null;
  }

  /** The place of the mesh under the pointer. */
  get touched(): Touched | null {
    return this.scene.touch(this.#at);
  }

  /** Begins to move the selected grips together, without a button. */
  start(gesture: Gesture): void {
    const chosen = this.grips.chosen();
    if (!chosen.length) return;
    this.doer.begin();
    [this.#motion, this.#from, this.#isDown] = [new Motion(gesture, chosen), this.#at, false];
    this.doer.refresh();
  }

  /** Ends the gesture; the grips go back unless it is wanted. */
  end(isWanted: boolean): void {
    if (!this.#motion) return;
    this.#motion = null;
    if (!isWanted) this.doer.cancel();
    this.doer.refresh();
  }

  /** Returns the grip at a place. */
  #gripAt([x, y]: [number, number]): Grip | null {
    const distance = ({ to }: Grip) => {
      const [px, py] = this.scene.project(to);
      return Math.hypot(px - x, py - y);
    };
    const near = this.grips.all.map((grip) => ({ grip, far: distance(grip) })).filter(({ far }) => far <= NEAR);
    return near.sort((a, b) => a.far - b.far)[0]?.grip ?? null;
  }

  #down(event: PointerEvent, pane: HTMLElement): void {
    if (event.button !== 0 || pane !== this.scene.pane) return;
    this.#at = placeIn(pane, event);
    if (this.#motion) {
      stop(event);
      return this.end(true);
    }
    const grip = this.#gripAt(this.#at);
    const touched = grip ? null : this.scene.touch(this.#at);
    if (!grip && !touched) return this.#empty();
    stop(event);
    pane.focus();
    pane.setPointerCapture(event.pointerId);
    this.doer.begin();
    const held = grip ?? this.doer.hold(touched!);
    if (event.shiftKey) this.grips.select(held.name, true);
    else if (!this.grips.selected.has(held.name)) this.grips.select(held.name);
    const together = this.grips.chosen();
    if (together.length) [this.#motion, this.#from, this.#isDown, this.#dragged] = [new Motion("grab", together), this.#at, true, false];
    this.doer.refresh();
  }

  #empty(): void {
    this.grips.select(null);
    this.doer.refresh();
  }

  #move(event: PointerEvent, pane: HTMLElement): void {
    if (pane !== this.scene.pane) return;
    this.#at = placeIn(pane, event);
    if (!this.#motion) {
      pane.style.cursor = this.#gripAt(this.#at) ? "grab" : "";
      return;
    }
    if (this.#isDown) stop(event);
    const far = Math.hypot(this.#at[0] - this.#from[0], this.#at[1] - this.#from[1]);
    if (!this.#dragged && this.#isDown && far < STILL) return;
    this.#dragged = true;
    this.doer.moved(this.#grips(this.#motion), this.#motion.gesture === "rotate");
  }

  /** Returns the grips as the gesture has moved them so far. */
  #grips(motion: Motion): Grip[] {
    const { scene } = this;
    const [from, to] = [this.#from, this.#at].map((at) => scene.placeAt(at, motion.pivot)) as [number[], number[]];
    if (motion.gesture === "grab") return motion.shifted(to.map((x, k) => x - from[k]!));
    const center = scene.project(motion.pivot);
    if (motion.gesture === "scale") return motion.scaled(stretched(center, this.#from, this.#at));
    return motion.turned(swept(center, this.#from, this.#at) * scene.handedness, scene.axis);
  }

  #up(event: PointerEvent): void {
    if (!this.#motion || !this.#isDown) return;
    stop(event);
    this.end(true);
  }
}

function placeIn(pane: HTMLElement, event: PointerEvent): [number, number] {
  const { left, top } = pane.getBoundingClientRect();
  return [event.clientX - left, event.clientY - top];
}

function stop(event: Event): void {
  event.stopImmediatePropagation();
  event.preventDefault();
}
