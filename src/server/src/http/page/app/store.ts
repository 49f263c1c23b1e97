// The state of the page. It has one owner, and views are functions of it.

import type { Grip } from "../pull/grips";
import type { Origin } from "../pull/what";
import type { Job } from "./api";
import { type Place, START, writePlace } from "./address";
import type { FormKind } from "./definitions";
import { type Camera, kept, keep, type Preset } from "./memory";
import type { Values } from "./option_form";
import type { Report } from "./reports";

/** A chosen mesh with the files that it may reference. */
export interface Chosen {
  name: string;
  content: Blob;
  resources: Map<string, Blob>;
  /** Path in the folder or archive that it came in, if it did. */
  path?: string;
  /** Direction from which it is seen first. */
  from?: readonly [number, number, number];
}

/** What the views show: a chosen file, or a job. There is none before the first one is fetched, or if the job of an
 * address does not exist. */
export type Subject =
  | { kind: "none" }
  | { kind: "missing" }
  | { kind: "file"; file: Chosen }
  | { kind: "job"; job: Job; report: Report | null; input: Chosen | null };

/** Everything that the page shows and that a person has set. */
export interface State {
  /** What the address says. */
  place: Place;
  subject: Subject;
  /** The files that were chosen here, or the sample. */
  chosen: Chosen[];
  /** Name of the folder or archive that they came in. */
  source: string | null;
  /** Files of a batch that the service refused, each with the cause. */
  refused: { batch: string; files: string[] } | null;
  /** The form: the kind of the next jobs, and their options that differ from the defaults. */
  kind: FormKind;
  options: Values;
  /** Gates of the next jobs: limits by name. */
  gates: Values;
  presets: Preset[];
  /** A file that was chosen in the pull view. */
  inHand: Origin | null;
}

/** Maximum number of models whose cameras are remembered. A camera takes some 100 bytes of the browser's 5 MB. */
const MOST_CAMERAS = 100;

/** Maximum number of files whose handles are remembered. A handle takes some 150 bytes. */
const MOST_PULLED = 20;

/** Owner of the state. */
export class Store {
  #state: State;
  readonly #views: (() => void)[] = [];
  #isTelling = false;
  #isStale = false;
  /** Cameras by model, least recent first. */
  readonly #cameras = new Map(kept("cameras"));
  /** Handles by what is pulled and how, least recent first. */
  readonly #grips = new Map(kept("grips"));

  constructor(place: Place) {
    const { kind = "unwrap", options = {}, gates = {} } = kept("form");
    this.#state = { place, subject: { kind: "none" }, chosen: [], source: null, refused: null, kind, options, gates, presets: kept("presets"), inHand: null };
  }

  get state(): Readonly<State> {
    return this.#state;
  }

  get place(): Readonly<Place> {
    return this.#state.place;
  }

  /** The job that is shown, if one is. */
  get job(): Job | null {
    const { subject } = this.#state;
    return subject.kind === "job" ? subject.job : null;
  }

  /** Adds a view, which is called after each change. */
  show(view: () => void): void {
    this.#views.push(view);
  }

  /** Changes the state and updates all views. */
  change(changes: Partial<State>): void {
    this.#state = { ...this.#state, ...changes };
    const { kind, options, gates } = this.#state;
    if ("kind" in changes || "options" in changes || "gates" in changes) keep("form", { kind, options, gates });
    if ("presets" in changes) keep("presets", this.#state.presets);
    this.#tell();
  }

  /** Changes what the address says; with `isNew`, the browser can go back to what it said before. */
  go(changes: Partial<Place>, isNew = false): void {
    const place = { ...this.place, ...changes };
    const isSame = Object.entries(changes).every(([name, value]) => String(value) === String(this.place[name as keyof Place]));
    if (isSame && !isNew) return;
    keep("looks", looksOf(place));
    writePlace(place, isNew);
    this.change({ place });
  }

  /** Tells the views, once more if one of them changed the state. */
  #tell(): void {
    this.#isStale = true;
    if (this.#isTelling) return;
    this.#isTelling = true;
    try {
      while (this.#isStale) {
        this.#isStale = false;
        for (const view of this.#views) view();
      }
    } finally {
      this.#isTelling = false;
    }
  }

  /** Remembers the cameras of a model. */
  remember(model: string, camera: Camera): void {
    this.#cameras.delete(model);
    this.#cameras.set(model, camera);
    for (const oldest of [...this.#cameras.keys()].slice(0, -MOST_CAMERAS)) this.#cameras.delete(oldest);
    keep("cameras", [...this.#cameras]);
  }

  /** Remembers the handles of what is pulled, or forgets them if there are none. */
  hold(pulled: string, grips: Grip[]): void {
    this.#grips.delete(pulled);
    if (grips.length) this.#grips.set(pulled, grips);
    for (const oldest of [...this.#grips.keys()].slice(0, -MOST_PULLED)) this.#grips.delete(oldest);
    keep("grips", [...this.#grips]);
  }

  /** Returns the handles of what was pulled before. */
  gripsOf(pulled: string): Grip[] {
    return this.#grips.get(pulled) ?? [];
  }

  /** Returns the cameras of a model as they were left. */
  cameraOf(model: string): Camera {
    return this.#cameras.get(model) ?? { camera: null, plane: null };
  }
}

/** Returns the part of a state that holds for all files: how they are filled, marked, pointed at, laid out and listed. */
function looksOf({ shade, measure, scale, seams, wire, problems, cells, mip, aim, alone, split, sheet, sort }: Place): Partial<Place> {
  return { shade, measure, scale, seams, wire, problems, cells, mip, aim, alone, split, sheet, sort };
}

/** Returns the place of another file or job: with the same looks, and nothing selected. */
export function elsewhere(place: Place): Place {
  return { ...START, ...looksOf(place) };
}

/** Identifies a model among files and jobs: jobs with the same input share it. */
export function modelOf(file: Pick<Chosen, "name" | "content" | "resources">): string {
  const others = [...file.resources.values()].reduce((sum, { size }) => sum + size, 0);
  return `${file.name}:${file.content.size + others}`;
}

export function modelOfJob({ filename, input_bytes }: Job): string {
  return `${filename}:${input_bytes}`;
}
