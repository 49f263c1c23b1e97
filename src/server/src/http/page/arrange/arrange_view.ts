// Manual arrangement of islands in the views: some are placed and stay; the others make room, or a job packs them around.

import { Vector3 } from "three";
import { createJob, type Job, outcomeOf } from "../app/api";
import { byId } from "../app/dom";
import { counted } from "../app/format";
import type { Report } from "../app/reports";
import type { Viewer } from "../app/viewer";
import type { Gesture } from "../viewer/gesture";
import { extension } from "../viewer/formats";
import { IDENTITY, type Point, scaleOf, type Similarity, turnOf } from "../viewer/similarity";
import { Arrangement, keyOf, moved, type Placed, type Snapshot } from "./arrangement";
import { around, middleOf } from "./islands";
import { ArrangePointer, type Doer } from "./pointer";
import { Room } from "./room";
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
  /** The islands being moved, the movement so far, and the islands that make room for them. */
  #moving: { by: Similarity; of: Moving; followers: Placed | null } | null = null;
  /** Set if other islands make room for those being moved. */
  #makesRoom = false;
  #room: Room | null = null;
  /** The arrangement that the session of `#room` has; its islands may still be growing. */
  #inRoom: Snapshot | null = null;
  /** Set while a job is submitted or opened; the views show the one before. */
  #isBusy = false;
  #wrong = new Set<number>();

  constructor(readonly viewer: Viewer, readonly told: Told) {
    this.#tools = new ArrangeTools((wish) => this.does(wish));
    this.#pointer = new ArrangePointer(byId("plane"), this);
    addEventListener("beforeunload", (event) => {
      if ([...this.#kept.values()].some((one) => one.isUnsaved)) event.preventDefault();
    });
    addEventListener("pagehide", () => this.#closeRoom());
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
      isOn: this.isOn, isOffered: this.#isOffered, isBusy: this.#isBusy, hasSelected: 0 < this.#selected.size, gesture: this.#pointer.gesture, makesRoom: this.#makesRoom, canUndo, canRedo, canBake: this.#arrangement?.isUnsaved ?? false,
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
    this.#scene.show({ placed: this.#placed, places: this.#places }, this.#selected, this.#wrong);
  }

  /** Places of the islands that stay, including those being moved. */
  get #placed(): Placed {
    const { now, places } = this.#arrangement ?? { now: { placed: new Map() }, places: new Map() };
    if (!this.#moving) return now.placed;
    const movedTo = moved(places, this.#keys, this.#moving.by);
    return new Map([...now.placed, ...this.#keys.map((key): [string, Similarity] => [key, movedTo.get(key)!])]);
  }

  /** Places of all islands that are not where the file has them. */
  get #places(): Placed {
    return new Map([...(this.#moving?.followers ?? this.#arrangement?.now.followers ?? []), ...this.#placed]);
  }

  /** Keys of the selected islands. */
  get #keys(): string[] {
    return [...this.#selected].map((chart) => keyOf(this.viewer.atlas, chart));
  }

  /** Reports the selected, locked and misplaced islands, in words and in the attributes of the views. */
  #say(): void {
    const panes = byId("panes").dataset;
    if (!this.isOn) return void ["selected", "locked", "wrong", "room"].forEach((name) => delete panes[name]);
    const locked = this.#scene?.locked(this.#placed) ?? [];
    Object.assign(panes, { selected: [...this.#selected].join(" "), locked: locked.join(" "), wrong: [...this.#wrong].join(" ") });
    if (this.#room) panes.room = this.#room.isSettled ? "settled" : "moving";
    else delete panes.room;
    const { gesture } = this.#pointer;
    const by = this.#moving?.by ?? IDENTITY;
    const moves = { grab: `moved by ${(by.s / this.aspect).toFixed(4)}, ${by.t.toFixed(4)}`, rotate: `turned by ${turnOf(by).toFixed(1)}°`, scale: `scaled by ${scaleOf(by).toFixed(3)}` };
    const sizes = [...(this.#moving?.followers ?? this.#arrangement?.now.followers ?? new Map<string, Similarity>()).values()].map(scaleOf);
    const size = Math.round(100 * Math.min(1, ...sizes));
    byId("pointed").textContent = [
      this.#isBusy ? "Repacking …" : "", this.#selected.size ? `${counted(this.#selected.size, "island")} selected` : "Select islands by clicks",
      gesture ? moves[gesture] : "", size < 100 ? `others at ${size} %` : "", locked.length ? `${locked.length} locked` : "", this.#wrong.size ? `${this.#wrong.size} too near to others or off the page` : "",
    ].filter(Boolean).join(" · ");
  }

  // ---- what the pointer does

  /** Selects the island after the selected one, or the one before. */
  #step(step: number): void {
    const charts = [...(this.#scene?.islands.keys() ?? [])].sort((one, other) => one - other);
    if (!charts.length) return;
    const [selected] = this.#selected;
    const from = selected === undefined ? (0 < step ? -1 : 0) : charts.indexOf(selected);
    this.#selected.clear();
    this.#selected.add(charts[(from + step + charts.length) % charts.length]!);
  }

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
    this.#room?.hold(this.#placed);
    this.refresh();
  }

  ended(by: Similarity | null): void {
    const arrangement = this.#arrangement;
    const followers = this.#moving?.followers ?? null;
    this.#moving = null;
    if (by && arrangement) {
      arrangement.move(this.#keys, by);
      if (followers) arrangement.follow(followers);
      this.#room?.hold(arrangement.now.placed);
      this.#inRoom = this.#room && arrangement.now;
    } else {
      this.#forgetRoom();
    }
    this.refresh();
  }

  #start(gesture: Gesture): void {
    const scene = this.#scene;
    if (!this.#selected.size || !scene) return;
    const places = this.#places;
    const boxes = [...this.#selected].map((chart) => scene.at(chart, places).box);
    if (this.#makesRoom) this.#openRoom(scene);
    const others = this.#room ? scene.locked(this.#placed) : scene.islands.keys();
    this.#moving = { by: IDENTITY, of: scene.moving(this.#selected, places, others), followers: null };
    this.#room?.begin(places, this.#inRoom === this.#arrangement!.now, this.#placed);
    this.#pointer.start(gesture, middleOf(around(boxes)));
  }

  // ---- islands that make room

  /** Opens a session on the shown atlas unless it is open. */
  #openRoom({ islands, analysis, atlas }: ArrangedScene): void {
    const { facts } = this.viewer;
    const { job } = this.#arrangement!.now;
    const primitives = this.#report?.written?.primitives;
    if (!facts || !primitives) return;
    const open = this.#room?.arranged;
    if (open?.job === job && open.atlas === atlas && open.analysis === analysis) return;
    this.#closeRoom();
    const room: Room = new Room({ job, facts, primitives, atlas, analysis, islands }, {
      follow: (followers) => this.#room === room && this.#followRoom(followers),
      ended: (error) => this.#room === room && this.#roomEnded(error),
    });
    this.#room = room;
  }

  #closeRoom(): void {
    const room = this.#room;
    this.#room = this.#inRoom = null;
    room?.close();
  }

  /** The session has another arrangement than the views. */
  #forgetRoom(): void {
    this.#inRoom = null;
    this.#room?.cancel();
  }

  /** Shows where the islands lie that make room. */
  #followRoom(followers: Placed): void {
    const arrangement = this.#arrangement;
    if (this.#moving) this.#moving.followers = followers;
    else if (arrangement && this.#inRoom === arrangement.now) {
      arrangement.follow(followers);
      this.#inRoom = arrangement.now;
    } else return;
    this.refresh();
  }

  #roomEnded(error: Error | null): void {
    this.#room = this.#inRoom = null;
    if (error) {
      this.#makesRoom = false;
      this.told.failed(error);
    }
    this.refresh();
  }

  // ---- what buttons and keys do

  leave(): void {
    if (!this.isOn) return;
    this.#pointer.end(false);
    this.#closeRoom();
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
      next: () => this.#step(1), previous: () => this.#step(-1), cancel: () => this.#selected.clear(), all: () => this.#scene?.islands.forEach((_, chart) => this.#selected.add(chart)),
      lock: () => this.#selected.size && this.#lock(arrangement),
      undo: () => arrangement.undo() && void this.#follow(), redo: () => arrangement.redo() && void this.#follow(),
      room: () => this.#toggleRoom(), bake: () => arrangement.isUnsaved && void this.#submit(this.#everything), repack: () => void this.#submit(arrangement.now.placed),
    };
    (pointer.gesture ? during : between)[wish]?.();
    this.refresh();
  }

  #toggleRoom(): void {
    this.#makesRoom = !this.#makesRoom;
    if (this.#makesRoom && this.#scene) this.#openRoom(this.#scene);
    else this.#closeRoom();
  }

  /** Locks or releases the selected islands. The session learns that in the next gesture. */
  #lock(arrangement: Arrangement): void {
    const isKnown = this.#inRoom === arrangement.now;
    arrangement.lock(this.#keys);
    this.#inRoom = isKnown && 0 < arrangement.now.followers.size ? arrangement.now : null;
  }

  type(character: string): void {
    this.#pointer.type(character);
  }

  // ---- jobs

  /** Shows the job of the current arrangement. */
  async #follow(): Promise<void> {
    const { job } = this.#arrangement!.now;
    this.#forgetRoom();
    this.#keep();
    if (job === this.viewer.place.job) return;
    this.#closeRoom();
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

  /** Places of all islands of the atlases in which any was moved or locked. */
  get #everything(): Placed {
    const places = this.#places;
    const touched = new Set([...places.keys()].map((key) => key.split("/")[0]));
    const all = this.viewer.analysis!.atlases.flatMap(({ charts }, atlas) => (touched.has(String(atlas)) ? Array.from({ length: charts }, (_, chart) => keyOf(atlas, chart)) : []));
    return new Map(all.map((key) => [key, places.get(key) ?? IDENTITY]));
  }

  /** Packs the other islands around those with places, and shows the result unless something else is shown by then. */
  async #submit(places: Placed): Promise<void> {
    const { analysis, facts, model } = this.viewer;
    const arrangement = this.#arrangement!;
    if (this.#wrong.size) return this.told.failed(new Error("Islands in red are too near to others that stay, or leave the page. Move them first."));
    const { primitives } = this.#report!.written!;
    const given = optionsOf(facts!, primitives!);
    if (!given) return this.told.failed(new Error("The primitives of this file have different UV sets: they cannot be packed together."));
    const options = { islands: wished(analysis!, model!.aspect, places, facts!, primitives!), ...given };
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
