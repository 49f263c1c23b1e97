// Islands that make room: a live session packs them around those that are held. See openapi/live.md.

import type { Analysis } from "../analysis/analysis";
import { call } from "../app/api";
import type { Facts } from "../app/source";
import { LiveClient, type Reply } from "../live/client";
import type { LiveFrame, LiveMesh } from "../live/decode";
import { openSession, type Session, socketOf } from "../pull/what";
import { IDENTITY, type Point, type Similarity } from "../viewer/similarity";
import { keyOf, type Placed } from "./arrangement";
import type { Island } from "./islands";
import { facesBefore, optionsOf, placementOf, type Primitive } from "./wish";

/** Callbacks of the live session. */
export interface Roomy {
  /** The islands that are not held lie there. */
  follow(followers: Placed): void;
  /** The session has ended, for a reason unless that was asked for. */
  ended(error: Error | null): void;
}

/** What is arranged: one atlas of the result of a job. */
export interface Arranged { job: string; analysis: Analysis; facts: Facts; primitives: Primitive[]; atlas: number; islands: Map<number, Island> }

/** Two vertices of an island far from each other, which tell its place: their numbers, and where they are in the file. */
interface Ends { numbers: [number, number]; at: [Point, Point] }

/** Lets the islands of an atlas make room for those that are held. */
export class Room {
  #session: Session | null = null;
  #client: LiveClient | null = null;
  #ends: Map<number, Ends> | null = null;
  /** What is to be held, and all places at the start of a gesture. */
  #wanted: { first: Placed; held: Placed } | null = null;
  /** What the session was told to hold; null if it must be told all places first. */
  #held: Placed | null = null;
  /** Last message about what is held. Earlier frames show something else. */
  #since = 0;
  #isMoving = false;
  #isOver = false;

  constructor(readonly arranged: Arranged, readonly roomy: Roomy) {
    void this.#open();
  }

  async #open(): Promise<void> {
    const { job, facts, primitives } = this.arranged;
    try {
      const options = optionsOf(facts, primitives);
      if (!options) throw new Error("The primitives of this file have different UV sets: they cannot be packed together.");
      const session = await openSession({ name: facts.source.name, job }, { kind: "repack", options });
      if (this.#isOver) return void end(session);
      this.#session = session;
    } catch (error) {
      return this.#end(error instanceof Error ? error : new Error(String(error)));
    }
    this.#client = new LiveClient(socketOf(this.#session), {
      mesh: (mesh) => this.#take(mesh),
      frame: (frame) => this.#frame(frame),
      reply: (reply) => this.#replied(reply),
      closed: () => this.#end(null),
    });
  }

  /** Set if the islands lie as they will for what is held. */
  get isSettled(): boolean {
    return !this.#isMoving && this.#held !== null && this.#held === this.#wanted?.held && this.#client?.isAnswered === true;
  }

  /** Ends the session. */
  close(): void {
    this.#end(null);
  }

  #end(error: Error | null): void {
    if (this.#isOver) return;
    this.#isOver = true;
    this.#client?.close();
    if (this.#session) end(this.#session);
    this.roomy.ended(error);
  }

  /** Begins a gesture: the places of all islands, whether the session has them, and those that are held. */
  begin(first: Placed, isKnown: boolean, held: Placed): void {
    if (!isKnown) this.#held = null;
    this.#wanted = { first, held };
    this.#since = Number.POSITIVE_INFINITY;
    this.#send();
  }

  /** Moves the islands that are held. */
  hold(held: Placed): void {
    if (!this.#wanted) return;
    this.#wanted.held = held;
    this.#send();
  }

  /** Gives up what was held: the islands lie elsewhere from now on. */
  cancel(): void {
    this.#wanted = this.#held = null;
    this.#since = Number.POSITIVE_INFINITY;
  }

  /** Sends what is wanted, once the session has caught up with what was sent before. */
  #send(): void {
    const { atlas, islands } = this.arranged;
    const wanted = this.#wanted;
    const client = this.#client;
    if (!client || !this.#ends || !wanted || !client.isAnswered) return;
    const add = (chart: number, by: Similarity) => client.say({ add: { name: chart, handle: placementOf(islands.get(chart)!, by, this.arranged) } });
    let last = 0;
    if (!this.#held) {
      // Hold every island where it is, then let go of those that make room: that moves nothing.
      client.say({ reset: {} });
      for (const chart of islands.keys()) last = add(chart, wanted.first.get(keyOf(atlas, chart)) ?? IDENTITY);
      this.#held = new Map([...islands.keys()].map((chart) => [keyOf(atlas, chart), IDENTITY]));
    }
    for (const chart of islands.keys()) {
      const key = keyOf(atlas, chart);
      const by = wanted.held.get(key);
      if (by && this.#held.get(key) !== by) last = add(chart, by);
      if (!by && this.#held.has(key)) last = client.say({ remove: { name: chart } });
    }
    this.#held = wanted.held;
    if (last) this.#since = last;
  }

  #take({ rest, elements }: LiveMesh): void {
    const { analysis, atlas, facts, primitives } = this.arranged;
    const before = facesBefore(facts, primitives);
    if (!before || before.at(-1) !== elements.length / 3) return this.#end(new Error("The view does not show all meshes of the file."));
    const aspect = facts.texture.width / facts.texture.height;
    const at = (vertex: number): Point => [rest[2 * vertex]! * aspect, 1 - rest[2 * vertex + 1]!];
    // Of each island the least and the greatest vertex along both axes.
    const extremes = new Map<number, number[]>();
    for (const { mesh, primitive, begin, count } of facts.origins) {
      const first = before[primitives.findIndex((one) => one.mesh === mesh && one.primitive === primitive)]!;
      for (let k = 0; k < 3 * count; k++) {
        const face = begin + Math.floor(k / 3);
        if (analysis.group[face] !== atlas) continue;
        const vertex = elements[3 * first + k]!;
        const found = extremes.get(analysis.chart[face]!) ?? [vertex, vertex, vertex, vertex];
        [0, 1].forEach((axis) => {
          if (at(vertex)[axis]! < at(found[axis]!)[axis]!) found[axis] = vertex;
          if (at(vertex)[axis]! > at(found[2 + axis]!)[axis]!) found[2 + axis] = vertex;
        });
        extremes.set(analysis.chart[face]!, found);
      }
    }
    this.#ends = new Map([...extremes].map(([chart, [left, low, right, high]]) => {
      const pairs = [[left!, right!], [low!, high!]] as [number, number][];
      const [, numbers] = pairs.map((pair): [number, [number, number]] => [distance(at(pair[0]), at(pair[1])), pair]).sort(([a], [b]) => b - a)[0]!;
      return [chart, { numbers, at: [at(numbers[0]), at(numbers[1])] }];
    }));
    this.#send();
  }

  #frame({ message, positions, stage }: LiveFrame): void {
    this.#isMoving = stage === "moving";
    if (this.#ends && this.#since <= message) {
      const { atlas, facts } = this.arranged;
      const aspect = facts.texture.width / facts.texture.height;
      const at = (vertex: number): Point => [positions[2 * vertex]! * aspect, 1 - positions[2 * vertex + 1]!];
      const followers = [...this.#ends].filter(([chart]) => !this.#held?.has(keyOf(atlas, chart)));
      this.roomy.follow(new Map(followers.map(([chart, ends]) => [keyOf(atlas, chart), between(ends.at, [at(ends.numbers[0]), at(ends.numbers[1])])])));
    }
    this.#send();
  }

  #replied({ error }: Reply): void {
    // An island that is larger than its page is red while it is scaled.
    if (error && error.code !== "island_off_page") this.#end(new Error(error.detail));
  }
}

function end(session: Session): void {
  void call(session.links.self, { method: "DELETE", keepalive: true }).catch(() => null);
}

function distance([x, y]: Point, [u, v]: Point): number {
  return Math.hypot(u - x, v - y);
}

/** Returns the similarity that takes two points to two others. */
function between([p, q]: [Point, Point], [to, further]: [Point, Point]): Similarity {
  const [x, y] = [q[0] - p[0], q[1] - p[1]];
  const [u, v] = [further[0] - to[0], further[1] - to[1]];
  const square = x * x + y * y;
  if (!square) return { ...IDENTITY, s: to[0] - p[0], t: to[1] - p[1] };
  const [a, b] = [(u * x + v * y) / square, (v * x - u * y) / square];
  return { a, b, s: to[0] - a * p[0] + b * p[1], t: to[1] - b * p[0] - a * p[1] };
}
