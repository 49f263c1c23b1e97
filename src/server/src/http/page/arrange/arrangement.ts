// The islands that stay, with their places and the history of changes.

import { after, IDENTITY, isStill, type Similarity } from "../viewer/similarity";

/** Places of the islands that stay, by atlas and chart. */
export type Placed = ReadonlyMap<string, Similarity>;

/** An arrangement of the result of a job. */
export interface Snapshot { job: string; placed: Placed }

export const keyOf = (atlas: number, chart: number) => `${atlas}/${chart}`;

/** The islands that stay, and their history across successive jobs. */
export class Arrangement {
  #now: Snapshot;
  #past: Snapshot[] = [];
  #future: Snapshot[] = [];

  constructor(job: string) {
    this.#now = { job, placed: new Map() };
  }

  get now(): Snapshot {
    return this.#now;
  }

  /** Set if an island was moved since the last job. */
  get isUnsaved(): boolean {
    return [...this.#now.placed.values()].some((by) => !isStill(by));
  }

  /** Replaces the current arrangement and records it for undo. */
  #change(next: Snapshot): void {
    this.#past.push(this.#now);
    this.#future = [];
    this.#now = next;
  }

  /** Moves islands from their current places; they stay from then on. */
  move(keys: string[], by: Similarity): void {
    this.#change({ ...this.#now, placed: moved(this.#now.placed, keys, by) });
  }

  /** Makes islands stay, or releases them: a released island returns to its place in the file. */
  lock(keys: string[]): void {
    const placed = new Map(this.#now.placed);
    const isLocked = keys.every((key) => placed.has(key));
    for (const key of keys) {
      if (isLocked) placed.delete(key);
      else if (!placed.has(key)) placed.set(key, IDENTITY);
    }
    this.#change({ ...this.#now, placed });
  }

  /** Adopts a job that has the islands at their places. */
  baked(job: string): void {
    this.#change({ job, placed: new Map([...this.#now.placed.keys()].map((key) => [key, IDENTITY])) });
  }

  undo(): boolean {
    return this.#step(this.#past, this.#future);
  }

  redo(): boolean {
    return this.#step(this.#future, this.#past);
  }

  get canUndo(): boolean {
    return 0 < this.#past.length;
  }

  get canRedo(): boolean {
    return 0 < this.#future.length;
  }

  #step(from: Snapshot[], to: Snapshot[]): boolean {
    const next = from.pop();
    if (!next) return false;
    to.push(this.#now);
    this.#now = next;
    return true;
  }
}

/** Returns the places after moving some islands. */
export function moved(placed: Placed, keys: string[], by: Similarity): Placed {
  return new Map([...placed, ...keys.map((key): [string, Similarity] => [key, after(placed.get(key) ?? IDENTITY, by)])]);
}
