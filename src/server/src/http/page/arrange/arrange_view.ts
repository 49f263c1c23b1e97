// Manual arrangement of islands in the views: some are placed and stay, and a job packs the others around them.

import { Vector3 } from "three";
import { createJob, type Job, outcomeOf } from "../app/api";
import { byId } from "../app/dom";
import { counted } from "../app/format";
import type { Report } from "../app/reports";
import type { Viewer } from "../app/viewer";
import type { Gesture } from "../viewer/gesture";
import { extension } from "../viewer/loading";
import { IDENTITY, type Point, scaleOf, type Similarity, turnOf } from "../viewer/similarity";
import { Arrangement, keyOf, moved, type Placed } from "./arrangement";
import { around, middleOf } from "./islands";
import { ArrangePointer, type Doer } from "./pointer";
import { ArrangedScene, type Moving } from "./scene";
import { ArrangeTools } from "./tools";
import { optionsOf, pagesOf, wished } from "./wish";

/** Callbacks to the page. */
export interface Told {
  failed(error: unknown): void;
  /** Another job is to be shown. */
  open(job: string): Promise<void>;
  changed(): void;
}

/** Arranges the islands of one job at a time. */
export class ArrangeView implements Doer {
  isOn = false;
  readonly #tools: ArrangeTools;
  readonly #pointer: ArrangePointer;
  /** Arrangement of each job. */
  readonly #kept = new Map<string, Arrangement>();
  #arrangement: Arrangement | null = null;
  #report: Report | null = null;
  #isOffered = false;
  #scene: ArrangedScene | null = null;
  readonly #selected = new Set<number>();
  /** The islands being moved, and the movement so far. */
  #moving: { by: Similarity; of: Moving } | null = null;
  /** Set while a job is submitted or opened; the views show the one before. */
  #isBusy = false;
  #wrong = new Set<number>();

  constructor(readonly viewer: Viewer, readonly told: Told) {
    this.#tools = new ArrangeTools((wish) => this.does(wish));
    this.#pointer = new ArrangePointer(byId("plane"), this);
    addEventListener("beforeunload", (event) => {
      if ([...this.#kept.values()].some((one) => one.isUnsaved)) event.preventDefault();
    });
  }

  /** Offers the result of a job for arranging, if that is what the views show. */
  offer(job: Job | null, report: Report | null): void {
    if (this.#isBusy) return this.refresh();
    const { analysis, facts, model } = this.viewer;
    const isMap = facts !== null && ["glb", "gltf"].includes(extension(facts.source.name)) && (analysis?.atlases.some(({ isMapped }) => isMapped) ?? false);
    this.#isOffered = job?.state === "succeeded" && report?.written?.primitives !== undefined && isMap && model !== null;
    this.#report = report;
    if (job && this.#isOffered) this.#take(job.id);
    else this.leave();
    this.refresh();
  }

  #take(job: string): void {
    if (this.#arrangement?.now.job === job) return;
    this.#arrangement = this.#kept.get(job) ?? new Arrangement(job);
    this.#kept.set(job, this.#arrangement);
    this.#selected.clear();
  }

  // ---- what is shown

  /** Updates everything from the arrangement. */
  refresh(): void {
    const { stage, pointing } = this.viewer;
    pointing.taken = this.isOn ? (target, isAlso) => this.#select(target?.face ?? null, isAlso) : null;
    if (this.isOn && !this.#isBusy) this.#show();
    if (stage) stage.uniforms.uArranging.value = Number(this.isOn && this.#scene !== null && this.#scene.analysis === this.viewer.analysis);
    const { canUndo = false, canRedo = false } = this.#arrangement ?? {};
    this.#tools.refresh({
      isOn: this.isOn, isOffered: this.#isOffered, isBusy: this.#isBusy, hasSelected: 0 < this.#selected.size, gesture: this.#pointer.gesture, canUndo, canRedo,
    });
    this.#say();
    stage?.redraw();
  }

  #show(): void {
    const { analysis, atlas, facts, model, stage } = this.viewer;
    if (!analysis || !facts || !model || !stage) return;
    if (this.#scene?.analysis !== analysis || this.#scene.atlas !== atlas) {
      this.#scene?.dispose();
      this.#selected.clear();
      this.#scene = new ArrangedScene(analysis, atlas, pagesOf(facts));
      stage.uniforms.uPlaced.value = this.#scene.placed.texture;
    }
    this.#wrong = this.#scene.faults(this.#placed, this.#moving?.of ?? null);
    this.#scene.show(this.#placed, this.#selected, this.#wrong);
  }

  /** Places of all islands, including those being moved. */
  get #placed(): Placed {
    const placed = this.#arrangement?.now.placed ?? new Map<string, Similarity>();
    return this.#moving ? moved(placed, this.#keys, this.#moving.by) : placed;
  }

  /** Keys of the selected islands. */
  get #keys(): string[] {
    return [...this.#selected].map((chart) => keyOf(this.viewer.atlas, chart));
  }

  /** Reports the selected, locked and misplaced islands, in words and in the attributes of the views. */
  #say(): void {
    const panes = byId("panes").dataset;
    if (!this.isOn) return void ["selected", "locked", "wrong"].forEach((name) => delete panes[name]);
    const locked = this.#scene?.locked(this.#placed) ?? [];
    Object.assign(panes, { selected: [...this.#selected].join(" "), locked: locked.join(" "), wrong: [...this.#wrong].join(" ") });
    const { gesture } = this.#pointer;
    const by = this.#moving?.by ?? IDENTITY;
    const moves = { grab: `moved by ${(by.s / this.aspect).toFixed(4)}, ${by.t.toFixed(4)}`, rotate: `turned by ${turnOf(by).toFixed(1)}°`, scale: `scaled by ${scaleOf(by).toFixed(3)}` };
    byId("pointed").textContent = [
      this.#isBusy ? "Repacking …" : "", this.#selected.size ? `${counted(this.#selected.size, "island")} selected` : "Select islands by clicks",
      gesture ? moves[gesture] : "", locked.length ? `${locked.length} locked` : "", this.#wrong.size ? `${this.#wrong.size} too near to others or off the page` : "",
    ].filter(Boolean).join(" · ");
  }

  // ---- what the pointer does

  #select(face: number | null, isAlso: boolean): void {
    const { analysis, atlas } = this.viewer;
    if (!analysis || this.#pointer.gesture || this.#isBusy) return;
    const chart = face !== null && analysis.group[face] === atlas ? analysis.chart[face]! : null;
    if (!isAlso) this.#selected.clear();
    if (chart !== null && !(isAlso && this.#selected.delete(chart))) this.#selected.add(chart);
    this.refresh();
  }

  get aspect(): number {
    return this.viewer.model?.aspect ?? 1;
  }

  inPlane([x, y]: Point): Point {
    return this.viewer.stage!.plane.at(x, y);
  }

  onPage([x, y]: Point): Point {
    return this.viewer.stage!.project("plane", new Vector3(x, y, 0));
  }

  moving(by: Similarity): void {
    if (!this.#moving) return;
    this.#moving.by = by;
    this.refresh();
  }

  ended(by: Similarity | null): void {
    this.#moving = null;
    if (by) this.#arrangement?.move(this.#keys, by);
    this.refresh();
  }

  #start(gesture: Gesture): void {
    const scene = this.#scene;
    if (!this.#selected.size || !scene) return;
    const placed = this.#placed;
    const boxes = [...this.#selected].map((chart) => scene.at(chart, placed).box);
    this.#moving = { by: IDENTITY, of: scene.moving(this.#selected, placed) };
    this.#pointer.start(gesture, middleOf(around(boxes)));
  }

  // ---- what buttons and keys do

  leave(): void {
    if (!this.isOn) return;
    this.#pointer.end(false);
    this.isOn = false;
    this.told.changed();
  }

  does(wish: string): void {
    if (wish === "toggle" && this.isOn) return this.leave();
    if (wish === "toggle") {
      this.isOn = this.#isOffered;
      return this.told.changed();
    }
    const arrangement = this.#arrangement;
    if (!this.isOn || this.#isBusy || !arrangement) return;
    const pointer = this.#pointer;
    const during: Record<string, () => void> = { x: () => pointer.constrain(0), y: () => pointer.constrain(1), confirm: () => pointer.end(true), cancel: () => pointer.end(false) };
    const between: Record<string, () => void> = {
      grab: () => this.#start("grab"), rotate: () => this.#start("rotate"), scale: () => this.#start("scale"),
      cancel: () => this.#selected.clear(), all: () => this.#scene?.islands.forEach((_, chart) => this.#selected.add(chart)),
      lock: () => this.#selected.size && arrangement.lock(this.#keys),
      undo: () => arrangement.undo() && void this.#follow(), redo: () => arrangement.redo() && void this.#follow(),
      repack: () => void this.#repack(),
    };
    (pointer.gesture ? during : between)[wish]?.();
    this.refresh();
  }

  type(character: string): void {
    this.#pointer.type(character);
  }

  // ---- jobs

  /** Shows the job of the current arrangement. */
  async #follow(): Promise<void> {
    const { job } = this.#arrangement!.now;
    this.#keep();
    if (job === this.viewer.place.job) return;
    this.#isBusy = true;
    await this.told.open(job);
    this.#isBusy = false;
    this.told.changed();
  }

  /** Stores the arrangement under its job. */
  #keep(): void {
    const arrangement = this.#arrangement!;
    this.#kept.forEach((one, job) => one === arrangement && this.#kept.delete(job));
    this.#kept.set(arrangement.now.job, arrangement);
  }

  /** Packs the other islands around those that stay, and shows the result unless something else is shown by then. */
  async #repack(): Promise<void> {
    const { analysis, facts, model } = this.viewer;
    const arrangement = this.#arrangement!;
    if (this.#wrong.size) return this.told.failed(new Error("Islands in red are too near to others that stay, or leave the page. Move them first."));
    const { primitives } = this.#report!.written!;
    const options = optionsOf(facts!, primitives!, wished(analysis!, model!.aspect, arrangement.now.placed, facts!, primitives!));
    if (!options) return this.told.failed(new Error("The primitives of this file have different UV sets: they cannot be packed together."));
    this.#isBusy = true;
    this.refresh();
    try {
      const job = await outcomeOf(await createJob("repack", options, facts!.source));
      const isShown = arrangement.now.job === this.viewer.place.job;
      arrangement.baked(job.id);
      if (isShown) await this.#follow();
      else this.#keep();
    } catch (error) {
      this.told.failed(error);
    }
    this.#isBusy = false;
    this.told.changed();
  }
}
