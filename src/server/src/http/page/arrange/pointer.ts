// Pointer gestures on islands: a key begins one, a click ends it.

import { type Gesture, stretched, swept } from "../viewer/gesture";
import { about, type Point, shifted, type Similarity } from "../viewer/similarity";

/** Receiver of gestures. */
export interface Doer {
  /** Width of the texture over its height, which is the unit of the plane. */
  readonly aspect: number;
  /** Converts a place on the page to the plane, and back. */
  inPlane(at: Point): Point;
  onPage(place: Point): Point;
  /** The islands are moved temporarily. */
  moving(by: Similarity): void;
  /** The islands stay there, or go back if it is null. */
  ended(by: Similarity | null): void;
}

interface Motion { gesture: Gesture; pivot: Point; from: Point; axis: 0 | 1 | null; typed: string }

/** Follows the pointer through one gesture at a time. */
export class ArrangePointer {
  #at: Point = [0, 0];
  #motion: Motion | null = null;
  /** Set if a press ended a gesture, so that its release is not a click. */
  #isSpent = false;

  constructor(readonly pane: HTMLElement, readonly doer: Doer) {
    addEventListener("pointermove", (event) => {
      this.#at = [event.clientX, event.clientY];
      this.#show();
    }, { capture: true });
    pane.addEventListener("pointerdown", (event) => {
      this.#isSpent = this.#motion !== null;
      if (!this.#motion) return;
      stop(event);
      pane.focus();
      this.end(event.button === 0);
    }, { capture: true });
    pane.addEventListener("pointerup", (event) => {
      if (this.#isSpent) stop(event);
      this.#isSpent = false;
    }, { capture: true });
  }

  get gesture(): Gesture | null {
    return this.#motion?.gesture ?? null;
  }

  start(gesture: Gesture, pivot: Point): void {
    this.#motion = { gesture, pivot, from: this.#at, axis: null, typed: "" };
    this.#show();
  }

  /** Restricts the movement to one axis, or lifts the restriction. */
  constrain(axis: 0 | 1): void {
    if (!this.#motion) return;
    this.#motion.axis = this.#motion.axis === axis ? null : axis;
    this.#show();
  }

  /** Adds a character to a typed number: degrees, a factor, or a distance along an axis. */
  type(character: string): void {
    if (!this.#motion) return;
    this.#motion.typed = character === "Backspace" ? this.#motion.typed.slice(0, -1) : this.#motion.typed + character;
    this.#show();
  }

  end(isWanted: boolean): void {
    const by = isWanted && this.#motion ? this.#by(this.#motion) : null;
    if (!this.#motion) return;
    this.#motion = null;
    this.doer.ended(by);
  }

  #show(): void {
    if (this.#motion) this.doer.moving(this.#by(this.#motion));
  }

  #by({ gesture, pivot, from, axis, typed }: Motion): Similarity {
    const number = typed === "" ? Number.NaN : Number(typed);
    const isTyped = Number.isFinite(number);
    const center = this.doer.onPage(pivot);
    if (gesture === "rotate") return about(pivot, isTyped ? number : swept(center, from, this.#at), 1);
    // Keep a minimum size: an island scaled to zero could not be scaled back.
    if (gesture === "scale") return about(pivot, 0, Math.max(isTyped ? number : stretched(center, from, this.#at), 1e-3));
    const [[x0, y0], [x1, y1]] = [from, this.#at].map((at) => this.doer.inPlane(at)) as [Point, Point];
    if (isTyped) return shifted(axis === 1 ? [0, number] : [number * this.doer.aspect, 0]);
    return shifted([axis === 1 ? 0 : x1 - x0, axis === 0 ? 0 : y1 - y0]);
  }
}

function stop(event: Event): void {
  event.stopImmediatePropagation();
  event.preventDefault();
}
