// The page's third view: a file that is pulled live.

import { call, type Job, Refused } from "../app/api";
import { byId, element, svg } from "../app/dom";
import { type Given, resourcesOf } from "../app/given";
import { LiveClient, type Reply, type Wish } from "../live/client";
import type { LiveFrame, LiveMesh } from "../live/decode";
import type { Store } from "../app/store";
import { extension } from "../viewer/formats";
import { type Grip, Grips, handleOf } from "./grips";
import { type Doer, Pointer } from "./pointer";
import type { Shown } from "./beside";
import { PullScene, type Touched } from "./scene";
import { PullTools } from "./tools";
import { type Known, type Origin, openSession, pulledOf, type Session, socketOf, type Way, waysOf } from "./what";

/** Reasons for the end of a session, in words. */
const ENDS: Record<string, string> = {
  expired: "The session ended: nothing was pulled for a while.", stopping: "The service stops.", closed: "The session was ended.",
};

/** Pause between attempts to go on after the service was lost. Shorter ones mean more requests. */
const RETRY_MS = 1000;

/** Callbacks to the page. */
export interface Told {
  failed(error: unknown): void;
  /** A session has begun or ended. */
  changed(): void;
  /** A session was baked to a job. */
  baked(job: Job): void;
  /** Returns what the page shows of the file that is offered. */
  shown(): Shown | null;
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
  /** Number of attempts to open a session, by which those that were given up are recognized. */
  #openings = 0;
  /** Set while the service is lost. */
  #isLost = false;
  /** Size of the next grip, as a share of the mesh. */
  #size = 0;

  constructor(readonly store: Store, readonly told: Told) {
    this.#scene = sceneOn();
    this.#pointer = this.#scene && new Pointer(this.#scene, this.grips, this);
    if (this.#scene) this.#scene.drawn = () => this.#drawGrips();
    this.#tools = new PullTools({
      start: (way) => void this.start(this.#ways[way] ?? null), take: (files) => this.takeFiles(files), resize: (share) => (this.#size = share),
      does: (wish) => this.does(wish), fill: (shade) => store.go({ shade }),
    });
    store.show(() => this.#fill());
    addEventListener("beforeunload", (event) => {
      if (this.#session && this.#isUnsaved) event.preventDefault();
    });
    addEventListener("pagehide", () => void this.#close());
  }

  /** Set while something is pulled. */
  get isActive(): boolean {
    return this.#session !== null;
  }

  /** Offers the file that the page shows for pulling. */
  offer(origin: Origin | null, known: Known | null): void {
    if (this.#session || this.#isLost) return;
    this.#origin = origin;
    if (!this.#scene) {
      this.#tools.offer(null, [], 0);
      return this.#tools.say("Pulling needs WebGL, which this browser does not show here.");
    }
    this.#ways = origin ? waysOf(origin.name, known) : [];
    const held = origin ? this.#ways.map((way) => this.store.gripsOf(pulledOf(origin, way)).length) : [];
    this.#tools.offer(origin?.name ?? null, this.#ways, held.find(Boolean) ?? 0);
  }

  /** Takes files that are chosen here. */
  takeFiles(files: Given[]): void {
    const [first, ...others] = files;
    if (!first) return;
    void this.#close();
    this.store.change({ inHand: { name: first.path.split("/").pop()!, content: first.content, resources: resourcesOf(first, [first], others) } });
  }

  /** Opens a session. */
  async start(way: Way | null): Promise<void> {
    if (!way || !this.#origin) return;
    await this.#close();
    this.#tools.say("Reading the file …");
    try {
      await this.#open(this.#origin, way);
    } catch (error) {
      this.#tools.say("Nothing is held. Choose another way, or another file.");
      this.told.failed(error);
    }
  }

  /** Opens a session with the handles that were held before. */
  async #open(origin: Origin, way: Way): Promise<void> {
    const mine = ++this.#openings;
    const session = await openSession(origin, way);
    if (mine !== this.#openings) return void call(session.links.self, { method: "DELETE" }).catch(() => null);
    [this.#session, this.#isLost] = [session, false];
    this.#way = way;
    this.#size = way.kind === "deform" ? 0.05 : 0;
    this.#client = new LiveClient(socketOf(this.#session), {
      mesh: (mesh) => (this.#shown = this.#show(mesh)),
      frame: (frame, waited) => void this.#shown.then(() => this.#frame(frame, waited)),
      reply: (reply, wish) => this.#replied(reply, wish),
      closed: (code, reason) => this.#closed(code, reason),
    });
    this.grips.restore(this.store.gripsOf(pulledOf(origin, way)));
    for (const grip of this.grips.all) this.#client.say({ add: { name: grip.name, handle: handleOf(grip) } });
    this.#isUnsaved = 0 < this.grips.all.length;
    this.#tools.started(origin.name, way, this.#size);
    this.told.changed();
  }

  /** The connection has ended: a service that is lost is asked again until it is back, and takes the handles again. */
  #closed(code: number, reason: string): void {
    const [origin, way] = [this.#origin, this.#way];
    const isLost = reason === "stopping" || code === 1006;
    this.#isLost = isLost;
    this.#ended(isLost ? "The service does not answer. Your handles are kept, and taken again as soon as it is back." : ENDS[reason] ?? `The computation ended: ${reason}.`);
    if (isLost && origin && way) void this.#goOn(origin, way, this.#openings);
  }

  async #goOn(origin: Origin, way: Way, opening: number): Promise<void> {
    while (this.#isLost && opening === this.#openings) {
      await new Promise((over) => setTimeout(over, RETRY_MS));
      if (!this.#isLost || opening !== this.#openings) return;
      try {
        return await this.#open(origin, way);
      } catch (error) {
        opening = this.#openings;
        // A service that answers, but not for a while, is asked again, too.
        if (!(error instanceof Refused) || 500 <= error.problem.status) continue;
        this.#isLost = false;
        this.#tools.say("Nothing is held any more.");
        this.told.failed(error);
      }
    }
  }

  /** Ends the session if there is one, and forgets its handles. */
  async leave(): Promise<void> {
    if (this.#session) this.#keep([]);
    await this.#close();
  }

  /** Remembers the handles. */
  #keep(grips: Grip[]): void {
    if (this.#origin && this.#way) this.store.hold(pulledOf(this.#origin, this.#way), grips);
  }

  async #close(): Promise<void> {
    this.#openings += 1;
    this.#isLost = false;
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
    await this.#scene?.show(mesh, { down: isDown ? mesh.picture[1] || 1 : null, picture, isMap: this.#way!.isMap, shown: this.told.shown() });
    this.#fill();
    this.#tools.say("");
  }

  /** Fills the surface beside as the views of the page are filled, with a checkerboard instead of what tells nothing of UVs. */
  #fill(): void {
    const { beside } = this.#scene ?? {};
    if (!beside) return;
    const { shade } = this.store.place;
    const filled = shade === "heat" || (shade === "material" && beside.hasPicture) ? shade : "checker";
    beside.fill(filled);
    this.#tools.filled(filled, beside.hasPicture);
    this.#scene!.refill();
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
    if (this.#session) this.#keep(this.grips.all);
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

/** Creates the scene of the page's third view; null without WebGL. */
function sceneOn(): PullScene | null {
  const pane = byId("pull-pane");
  const places = { plane: element("div", { className: "pane" }), solid: element("div", { className: "pane", hidden: true }) };
  for (const place of Object.values(places)) {
    place.tabIndex = 0;
    place.setAttribute("role", "application");
    place.setAttribute("aria-label", "What is pulled: press to hold, drag to pull");
    pane.insertBefore(place, byId("pull-grips"));
  }
  try {
    return new PullScene(byId<HTMLCanvasElement>("pull-canvas"), places);
  } catch {
    return null;
  }
}

/** Marks every handle at its place in the view. */
function showMarks(scene: PullScene, grips: Grips): void {
  byId("pull-grips").replaceChildren(...grips.all.map((grip) => mark(scene, grip, grips.selected.has(grip.name))));
}

function mark(scene: PullScene, grip: Grip, isSelected: boolean): SVGElement {
  const [cx, cy] = scene.project(grip.to);
  const classes = ["grip", isSelected && "selected", grip.isLocked && "locked"].filter(Boolean).join(" ");
  const drawn = grip.isLocked ? svg("rect", { x: cx - 5, y: cy - 5, width: 10, height: 10, class: classes }) : svg("circle", { cx, cy, r: 6, class: classes });
  drawn.append(svg("title", {}, `Handle ${grip.name + 1}`));
  return drawn;
}
