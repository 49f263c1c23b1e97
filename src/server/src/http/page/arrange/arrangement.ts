// Which islands stay and where they are put, with all that was before.

import { after, IDENTITY, isStill, type Similarity } from "../viewer/similarity";

/** Islands that stay, by atlas and chart, with where they are put. */
export type Placed = ReadonlyMap<string, Similarity>;

/** An arrangement of what a job made. */
export interface Snapshot { job: string; placed: Placed }

export const keyOf = (atlas: number, chart: number) => `${atlas}/${chart}`;

/** The islands that stay, and their history, over all jobs that follow from each other. */
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

  /** Whether something was moved that no job has. */
  get isUnsaved(): boolean {
    return [...this.#now.placed.values()].some((by) => !isStill(by));
  }

  /** Replaces what is, so that it can be had again. */
  #change(next: Snapshot): void {
    this.#past.push(this.#now);
    this.#future = [];
    this.#now = next;
  }

  /** Moves islands from where they are; those that are moved stay. */
  move(keys: string[], by: Similarity): void {
    this.#change({ ...this.#now, placed: moved(this.#now.placed, keys, by) });
  }

  /** Has islands stay, or else go back: one that does not stay lies where the file has it. */
  lock(keys: string[]): void {
    const placed = new Map(this.#now.placed);
    const isLocked = keys.every((key) => placed.has(key));
    for (const key of keys) {
      if (isLocked) placed.delete(key);
      else if (!placed.has(key)) placed.set(key, IDENTITY);
    }
    this.#change({ ...this.#now, placed });
  }

  /** Another job has the islands where they were put. */
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

/** Islands put elsewhere from where they are. */
export function moved(placed: Placed, keys: string[], by: Similarity): Placed {
  return new Map([...placed, ...keys.map((key): [string, Similarity] => [key, after(placed.get(key) ?? IDENTITY, by)])]);
}
