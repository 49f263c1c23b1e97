// The islands that stay and those that made room, with their places and the history of changes.

import { after, IDENTITY, isStill, type Similarity } from "../viewer/similarity";

/** Places of the islands that stay, by atlas and chart. */
export type Placed = ReadonlyMap<string, Similarity>;

/** An arrangement of the result of a job: the islands that stay, and those that made room for them. */
export interface Snapshot { job: string; placed: Placed; followers: Placed }

export const keyOf = (atlas: number, chart: number) => `${atlas}/${chart}`;

/** The islands that stay, and their history across successive jobs. */
export class Arrangement {
  #now: Snapshot;
  #past: Snapshot[] = [];
  #future: Snapshot[] = [];

  constructor(job: string) {
    this.#now = { job, placed: new Map(), followers: new Map() };
  }

  get now(): Snapshot {
    return this.#now;
  }

  /** Set if an island was moved since the last job. */
  get isUnsaved(): boolean {
    return [...this.places.values()].some((by) => !isStill(by));
  }

  /** Places of all islands that are not where the file has them. */
  get places(): Placed {
    return new Map([...this.#now.followers, ...this.#now.placed]);
  }

  /** Replaces the current arrangement and records it for undo. */
  #change(next: Snapshot): void {
    this.#past.push(this.#now);
    this.#future = [];
    this.#now = next;
  }

  /** Moves islands from their current places; they stay from then on. */
  move(keys: string[], by: Similarity): void {
    const placed = new Map([...this.#now.placed, ...moved(this.places, keys, by)].filter(([key]) => this.#now.placed.has(key) || keys.includes(key)));
    this.#change({ ...this.#now, placed, followers: without(this.#now.followers, keys) });
  }

  /** Puts the islands that make room for the present arrangement somewhere. */
  follow(followers: Placed): void {
    this.#now = { ...this.#now, followers: without(followers, [...this.#now.placed.keys()]) };
  }

  /** Makes islands stay, or releases them: a released island returns to its place in the file, unless others have made room. */
  lock(keys: string[]): void {
    const [placed, followers] = [new Map(this.#now.placed), new Map(this.#now.followers)];
    const isLocked = keys.every((key) => placed.has(key));
    const hasRoom = 0 < followers.size;
    for (const key of keys) {
      const by = placed.get(key) ?? followers.get(key) ?? IDENTITY;
      placed.delete(key);
      followers.delete(key);
      if (!isLocked) placed.set(key, by);
      else if (hasRoom) followers.set(key, by);
    }
    this.#change({ ...this.#now, placed, followers });
  }

  /** Adopts a job that has the islands that stay at their places. */
  baked(job: string): void {
    this.#change({ job, placed: new Map([...this.#now.placed.keys()].map((key) => [key, IDENTITY])), followers: new Map() });
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

function without(places: Placed, keys: string[]): Placed {
  return new Map([...places].filter(([key]) => !keys.includes(key)));
}
