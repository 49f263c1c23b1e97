// The page's third view: a file that is pulled live.

import { call, type Job } from "../app/api";
import { LiveClient, type Reply, type Wish } from "../live/client";
import type { LiveFrame, LiveMesh } from "../live/decode";
import type { Store } from "../app/store";
import { extension } from "../viewer/loading";
import { type Grip, Grips, handleOf } from "./grips";
import { type Doer, Pointer } from "./pointer";
import { sceneOn, showMarks } from "./pane";
import type { PullScene, Touched } from "./scene";
import { PullTools } from "./tools";
import { type Known, type Origin, openSession, type Session, socketOf, type Way, waysOf } from "./what";

/** Reasons for the end of a session, in words. */
const ENDS: Record<string, string> = {
  expired: "The session ended: nothing was pulled for a while.", stopping: "The service stops.", closed: "The session was ended.",
};

/** Callbacks to the page. */
export interface Told {
  failed(error: unknown): void;
  /** A session has begun or ended. */
  changed(): void;
  /** A session was baked to a job. */
  baked(job: Job): void;
}

/** Pulls one file at a time. */
export class PullView implements Doer {
  readonly grips = new Grips();
  readonly #scene: PullScene | null;
  readonly #pointer: Pointer | null;
  readonly #tools: PullTools;
  /** What is pulled, or was offered for it. */
  #origin: Origin | null = null;
  #ways: Way[] = [];
  #way: Way | null = null;
  #session: Session | null = null;
  #client: LiveClient | null = null;
  #shown = Promise.resolve();
  #latest: LiveFrame | null = null;
  /** Timer of the next search for faults, and the step of the scene at the last one. */
  #judging = 0;
  #latestStep = -1;
  /** Set if something was pulled since the last bake. */
  #isUnsaved = false;
  /** Size of the next grip, as a share of the mesh. */
  #size = 0;

  constructor(readonly store: Store, readonly told: Told) {
    this.#scene = sceneOn();
    this.#pointer = this.#scene && new Pointer(this.#scene, this.grips, this);
    if (this.#scene) this.#scene.drawn = () => this.#drawGrips();
    this.#tools = new PullTools({
      start: (way) => void this.start(this.#ways[way] ?? null), take: (files) => this.takeFiles(files), resize: (share) => (this.#size = share),
      does: (wish) => this.does(wish),
    });
    addEventListener("beforeunload", (event) => {
      if (this.#session && this.#isUnsaved) event.preventDefault();
    });
    addEventListener("pagehide", () => void this.leave());
  }

  /** Set while something is pulled. */
  get isActive(): boolean {
    return this.#session !== null;
  }

  /** Offers the file that the page shows for pulling. */
  offer(origin: Origin | null, known: Known | null): void {
    if (this.#session) return;
    this.#origin = origin;
    if (!this.#scene) {
      this.#tools.offer(null, []);
      return this.#tools.say("Pulling needs WebGL, which this browser does not show here.");
    }
    this.#ways = origin ? waysOf(origin.name, known) : [];
    this.#tools.offer(origin?.name ?? null, this.#ways);
  }

  /** Takes files that are chosen here. */
  takeFiles(files: File[]): void {
    const [first, ...others] = files;
    if (!first) return;
    void this.leave();
    this.store.change({ inHand: { name: first.name, content: first, resources: new Map(others.map((file) => [file.name, file as Blob])) } });
  }

  /** Opens a session. */
  async start(way: Way | null): Promise<void> {
    if (!way || !this.#origin) return;
    await this.leave();
    this.#tools.say("Reading the file …");
    try {
      this.#session = await openSession(this.#origin, way);
    } catch (error) {
      this.#tools.say("Nothing is held. Choose another way, or another file.");
      return this.told.failed(error);
    }
    this.#way = way;
    this.#size = way.kind === "deform" ? 0.05 : 0;
    this.#client = new LiveClient(socketOf(this.#session), {
      mesh: (mesh) => (this.#shown = this.#show(mesh)),
      frame: (frame, waited) => void this.#shown.then(() => this.#frame(frame, waited)),
      reply: (reply, wish) => this.#replied(reply, wish),
      closed: (_, reason) => this.#ended(ENDS[reason] ?? `The computation ended: ${reason || "the connection was lost"}.`),
    });
    this.#tools.started(this.#origin.name, way, this.#size);
    this.told.changed();
  }

  /** Ends the session if there is one. */
  async leave(): Promise<void> {
    const session = this.#session;
    this.#client?.close();
    this.#ended("");
    if (session) await call(session.links.self, { method: "DELETE", keepalive: true }).catch(() => null);
  }

  #ended(why: string): void {
    const wasActive = this.isActive;
    this.#session = this.#client = null;
    this.#isUnsaved = false;
    this.grips.take([]);
    this.#scene?.clear();
    this.#drawGrips();
    this.#tools.ended(why);
    if (wasActive) this.told.changed();
  }

  async #show(mesh: LiveMesh): Promise<void> {
    const { name } = this.#origin!;
    const isDown = mesh.picture[1] > 0 || (this.#way!.isMap && ["glb", "gltf"].includes(extension(name)));
    const picture = mesh.picture[1] > 0 && "content" in this.#origin! ? this.#origin.content : null;
    await this.#scene?.show(mesh, { down: isDown ? mesh.picture[1] || 1 : null, picture, isMap: this.#way!.isMap });
    this.#tools.say("");
  }

  /** Draws a frame; of several between two drawings only the latest is drawn. */
  #frame(frame: LiveFrame, waited: number | null): void {
    const isAsked = this.#latest !== null;
    this.#latest = frame;
    if (waited !== null) this.#tools.waited(waited);
    if (isAsked) return;
    requestAnimationFrame(() => {
      const latest = this.#latest;
      this.#latest = null;
      if (!latest || !this.#client) return;
      this.#scene?.move(latest.positions);
      this.#tools.frame(latest);
      this.#judge();
    });
  }

  /** Reports overlaps and charts beyond the page, spending at most a fifth of the time on it. */
  #judge(): void {
    const scene = this.#scene;
    if (!scene?.isMap || this.#judging) return;
    const begin = performance.now();
    this.#tools.judged(scene.faults());
    this.#judging = window.setTimeout(() => {
      this.#judging = 0;
      if (this.#latestStep !== scene.step) this.#judge();
    }, Math.max(100, 4 * (performance.now() - begin)));
    this.#latestStep = scene.step;
  }

  #replied({ error, handles }: Reply, wish: Wish | null): void {
    if (handles) this.grips.take(handles);
    if (error && wish && "add" in wish) this.#refused(wish.add.name, error.code);
    if (error) this.#tools.note(error.detail);
    this.refresh();
  }

  /** Handles a rejected grip: a disc that holds nothing becomes a point, and a point is removed. */
  #refused(name: number, code: string): void {
    const grip = this.grips.all.find((one) => one.name === name);
    if (!grip) return;
    if (grip.radius && ["handle_outside", "unknown_handle", "no_handle"].includes(code)) {
      grip.radius = 0;
      this.#client?.say({ add: { name, handle: handleOf(grip) } });
    } else {
      this.grips.drop(name);
    }
  }

  // ---- what the pointer and the keys do

  begin(): void {
    this.#client?.say({ remember: {} });
    this.#isUnsaved = true;
  }

  hold({ at, to }: Touched): Grip {
    const grip = this.grips.add(at, to, this.#way?.isMap || !this.#scene ? 0 : this.#size * this.#scene.extent);
    this.#client?.say({ add: { name: grip.name, handle: handleOf(grip) } });
    return grip;
  }

  moved(grips: Grip[], isTurned: boolean): void {
    for (const moved of grips) {
      const own = this.grips.all.find(({ name }) => name === moved.name);
      if (!own) continue;
      Object.assign(own, moved);
      const { name, to } = moved;
      this.#client?.say(isTurned && moved.radius ? { add: { name, handle: handleOf(moved) } } : { move: { name, to } });
    }
    this.#scene?.redraw();
  }

  cancel(): void {
    this.#client?.say({ undo: {} });
  }

  refresh(): void {
    this.#tools.refresh(this.grips, this.#pointer?.gesture ?? null);
    this.#scene?.redraw();
  }

  /** Executes the command of a button or a key. */
  does(wish: string): void {
    const client = this.#client;
    if (!client) return;
    const { grips } = this;
    const acts: Record<string, () => void> = {
      undo: () => client.say({ undo: {} }), redo: () => client.say({ redo: {} }), bake: () => void this.bake(),
      reset: () => { this.begin(); client.say({ reset: {} }); },
      grab: () => this.#pointer?.start("grab"), rotate: () => this.#pointer?.start("rotate"), scale: () => this.#pointer?.start("scale"),
      lock: () => grips.lock(), next: () => grips.selectNext(),
      pin: () => { const touched = this.#pointer?.touched; if (touched) { this.begin(); this.hold(touched); } },
      let_go: () => this.#letGo(), confirm: () => this.#pointer?.end(true), frame: () => this.#scene?.frame(),
      cancel: () => (this.#pointer?.gesture ? this.#pointer.end(false) : grips.select(null)),
      all: () => grips.all.forEach(({ name }) => grips.select(name, true)), end: () => void this.leave(),
    };
    acts[wish]?.();
    this.refresh();
  }

  #letGo(): void {
    const chosen = this.grips.chosen(true);
    if (!chosen.length) return;
    this.begin();
    for (const { name } of chosen) {
      this.#client?.say({ remove: { name } });
      this.grips.drop(name);
    }
  }

  /** Bakes the session to a job. */
  async bake(): Promise<void> {
    if (!this.#session) return;
    try {
      const job = await call<Job>(this.#session.links.bake, { method: "POST" });
      this.#isUnsaved = false;
      this.told.baked(job);
    } catch (error) {
      this.told.failed(error);
    }
  }

  #drawGrips(): void {
    if (this.#scene) showMarks(this.#scene, this.grips);
  }
}
