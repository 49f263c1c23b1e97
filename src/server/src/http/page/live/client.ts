// A client of live sessions: see openapi/live.md.

import { decode, type LiveFrame, type LiveMesh } from "./decode";

/** A handle in the format of the options of a job. */
export type Handle =
  | { at: number[]; to: number[] }
  | { vertex: number; to: number[] }
  | { center: number[]; radius: number; to: number[]; turn?: number; axis?: number[] };

/** An island that is held. */
export interface HeldIsland { primitive: number; face: number; move?: number[]; turn?: number; scale?: number; pivot?: number[] }

/** Command of a client. */
export type Wish =
  | { add: { name: number; handle: Handle | HeldIsland } }
  | { move: { name: number; to: number[] } }
  | { remove: { name: number } }
  | { settings: Record<string, unknown> }
  | { remember: object } | { undo: object } | { redo: object } | { reset: object } | { list: object };

/** Reply to a command. */
export interface Reply {
  n: number;
  step: number;
  superseded?: boolean;
  handles?: { name: number; handle: Handle }[];
  error?: { code: string; detail: string };
}

/** Listener to a session. */
export interface Listener {
  mesh(mesh: LiveMesh): void;
  frame(frame: LiveFrame, milliseconds: number | null): void;
  reply(reply: Reply, wish: Wish | null): void;
  closed(code: number, reason: string): void;
}

/** A connection to a session. */
export class LiveClient {
  readonly #socket: WebSocket;
  #n = 0;
  /** Times at which commands were sent that no frame contains yet, and commands without a reply. */
  readonly #sent = new Map<number, number>();
  readonly #wishes = new Map<number, Wish>();

  constructor(url: URL, listener: Listener) {
    this.#socket = new WebSocket(url);
    this.#socket.binaryType = "arraybuffer";
    this.#socket.onmessage = ({ data }: MessageEvent<ArrayBuffer | string>) => {
      if (typeof data === "string") return this.#replied(JSON.parse(data) as Reply, listener);
      const said = decode(data);
      if ("mesh" in said) listener.mesh(said.mesh);
      else listener.frame(said.frame, this.#waited(said.frame.message));
    };
    this.#socket.onclose = ({ code, reason }) => listener.closed(code, reason);
  }

  /** Sends a command and returns its number. */
  say(wish: Wish): number {
    const n = ++this.#n;
    this.#sent.set(n, performance.now());
    this.#wishes.set(n, wish);
    const text = JSON.stringify({ n, ...wish });
    if (this.#socket.readyState === WebSocket.CONNECTING) this.#socket.addEventListener("open", () => this.#socket.send(text), { once: true });
    else this.#socket.send(text);
    return n;
  }

  close(): void {
    this.#socket.onclose = null;
    this.#socket.close();
  }

  /** Set if every command sent is contained in a frame. */
  get isAnswered(): boolean {
    return this.#sent.size === 0;
  }

  #replied(reply: Reply, listener: Listener): void {
    const wish = this.#wishes.get(reply.n) ?? null;
    this.#wishes.delete(reply.n);
    listener.reply(reply, wish);
  }

  /** Returns the milliseconds since the latest message of a frame was sent, if no earlier frame contained it. */
  #waited(message: number): number | null {
    const sent = this.#sent.get(message);
    for (const n of this.#sent.keys()) if (n <= message) this.#sent.delete(n);
    return sent === undefined ? null : performance.now() - sent;
  }
}
