// The handles of a session: their list, the selection, and moving them together.

import type { Handle } from "../live/client";
import type { Gesture } from "../viewer/gesture";

/** A handle under editing. */
export interface Grip {
  name: number;
  /** Place on the mesh at rest that it holds. */
  at: number[];
  to: number[];
  /** Radius of a disc; 0 for a point. */
  radius: number;
  /** Rotation in degrees, and in space its axis. */
  turn: number;
  axis: number[] | null;
  /** Set if it stays when others are moved together. */
  isLocked: boolean;
}

/** Converts a grip to a handle. */
export function handleOf({ at, to, radius, turn, axis }: Grip): Handle {
  if (radius === 0) return { at, to };
  return { center: at, radius, to, turn, ...(axis ? { axis } : {}) };
}

/** Converts a handle to a grip. */
function gripOf(name: number, handle: Handle, isLocked: boolean): Grip {
  if ("center" in handle) {
    const { center, radius, to, turn = 0, axis = null } = handle;
    return { name, at: center, to, radius, turn, axis, isLocked };
  }
  return { name, at: "at" in handle ? handle.at : handle.to, to: handle.to, radius: 0, turn: 0, axis: null, isLocked };
}

/** All grips, with the selection. */
export class Grips {
  all: Grip[] = [];
  readonly selected = new Set<number>();
  #next = 0;

  /** Adds a grip for a place on the mesh at rest, which is now elsewhere. */
  add(at: number[], to: number[], radius: number): Grip {
    const grip: Grip = { name: this.#next++, at, to, radius, turn: 0, axis: null, isLocked: false };
    this.all.push(grip);
    this.select(grip.name);
    return grip;
  }

  /** Takes the grips of an earlier session. */
  restore(grips: Grip[]): void {
    this.all = grips.map((grip) => ({ ...grip }));
    this.#next = Math.max(0, ...grips.map(({ name }) => name + 1));
  }

  drop(name: number): void {
    this.all = this.all.filter((grip) => grip.name !== name);
    this.selected.delete(name);
  }

  /** Replaces the grips by the handles of the service. */
  take(handles: { name: number; handle: Handle }[]): void {
    const locked = new Set(this.all.filter(({ isLocked }) => isLocked).map(({ name }) => name));
    this.all = handles.map(({ name, handle }) => gripOf(name, handle, locked.has(name)));
    for (const name of [...this.selected]) if (!this.all.some((grip) => grip.name === name)) this.selected.delete(name);
    this.#next = Math.max(this.#next, ...this.all.map(({ name }) => name + 1));
  }

  select(name: number | null, isAlso = false): void {
    if (!isAlso) this.selected.clear();
    if (name !== null) this.selected.add(name);
  }

  /** Selects the grip after the selected one. */
  selectNext(): void {
    const at = this.all.findIndex(({ name }) => this.selected.has(name));
    const next = this.all[(at + 1) % this.all.length];
    if (next) this.select(next.name);
  }

  lock(): void {
    for (const grip of this.chosen(true)) grip.isLocked = !grip.isLocked;
  }

  /** Returns the grips to move: the selected ones that are not locked. */
  chosen(withLocked = false): Grip[] {
    return this.all.filter(({ name, isLocked }) => this.selected.has(name) && (withLocked || !isLocked));
  }
}

/** Movement of grips, from their state when the gesture began. */
export class Motion {
  readonly #before: Grip[];
  /** Center of rotating and scaling. */
  readonly pivot: number[];

  constructor(readonly gesture: Gesture, grips: Grip[]) {
    this.#before = grips.map((grip) => ({ ...grip }));
    const [first] = grips;
    this.pivot = (first?.to ?? []).map((_, k) => grips.reduce((sum, { to }) => sum + to[k]!, 0) / grips.length);
  }

  get names(): number[] {
    return this.#before.map(({ name }) => name);
  }

  /** Returns the grips shifted. */
  shifted(by: number[]): Grip[] {
    return this.#before.map((grip) => ({ ...grip, to: grip.to.map((x, k) => x + by[k]!) }));
  }

  /** Returns the grips turned by degrees, counter-clockwise in the coordinates of the plane or as seen against the
   * axis. */
  turned(degrees: number, axis: number[] | null): Grip[] {
    return this.#before.map((grip) => ({
      ...grip,
      to: rotated(grip.to, this.pivot, degrees, axis),
      // A disc that was turned about another axis before starts from zero.
      turn: (isSame(grip.axis, axis) ? grip.turn : 0) + degrees,
      axis: grip.radius ? axis : null,
    }));
  }

  scaled(factor: number): Grip[] {
    return this.#before.map((grip) => ({ ...grip, to: grip.to.map((x, k) => this.pivot[k]! + factor * (x - this.pivot[k]!)) }));
  }
}

function isSame(a: number[] | null, b: number[] | null): boolean {
  return a === b || (a !== null && b !== null && a.every((x, k) => Math.abs(x - b[k]!) < 1e-6));
}

function rotated(point: number[], pivot: number[], degrees: number, axis: number[] | null): number[] {
  const angle = (degrees * Math.PI) / 180;
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  const d = point.map((x, k) => x - pivot[k]!);
  if (!axis) return [pivot[0]! + cos * d[0]! - sin * d[1]!, pivot[1]! + sin * d[0]! + cos * d[1]!];
  // Rodrigues' rotation formula.
  const along = axis.reduce((sum, a, k) => sum + a * d[k]!, 0) * (1 - cos);
  const cross = [0, 1, 2].map((k) => axis[(k + 1) % 3]! * d[(k + 2) % 3]! - axis[(k + 2) % 3]! * d[(k + 1) % 3]!);
  return [0, 1, 2].map((k) => pivot[k]! + cos * d[k]! + sin * cross[k]! + along * axis[k]!);
}
