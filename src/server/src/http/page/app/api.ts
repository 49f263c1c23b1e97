// Client of the service. All addresses are relative to the page, which may lie below any prefix.

import { signIn } from "./sign_in";
import { extension } from "../viewer/formats";

/** A job, in the JSON of the service. */
export interface Job {
  id: string;
  kind: string;
  seq: number;
  state: "queued" | "running" | "succeeded" | "failed" | "cancelled";
  stage: string | null;
  fraction: number;
  chart: number;
  charts: number;
  iteration: number;
  energy: number | null;
  smallest: number | null;
  elapsed_ms: number;
  filename: string;
  input_bytes: number;
  options: Record<string, unknown>;
  priority: number;
  /** Owner of the key that made the job; null if it was made without one. */
  owner: string | null;
  metadata: Record<string, unknown>;
  /** The gates, and the outcome of judging the result by them. */
  accept: string | null;
  accepted: boolean | null;
  cached: boolean;
  created_at: string;
  started_at: string | null;
  finished_at: string | null;
  expires_at: string | null;
  certified: boolean | null;
  within_bound: boolean | null;
  warnings: { code: string; message: string }[];
  error?: Problem;
  links: { self: string; events: string; inputs: FileLink[]; files: FileLink[] };
}

/** A file of a job. A picture has no size before it is drawn, on its first request. */
export interface FileLink { href: string; name: string; bytes?: number }
export interface Problem { code: string; title: string; detail: string; status: number }

/** Members of a job that change while it runs. */
export type Progress = Pick<Job, "seq" | "state" | "stage" | "fraction" | "chart" | "charts" | "iteration" | "energy" | "smallest" | "elapsed_ms">;

/** A problem reported by the service. */
export class Refused extends Error {
  constructor(readonly problem: Problem) {
    super(problem.detail ? `${problem.title}: ${problem.detail}` : problem.title);
  }
}

/** Returns an address of the service relative to the page, without the prefix of a proxy. */
export function address(path: string): string {
  return path.replace(/^\/(?:.*?\/(?=v1\/))?/, "");
}

/** Calls the service; errors explain the problem in words. */
export async function call<T>(path: string, request: RequestInit = {}): Promise<T> {
  const answer = await reach(path, request);
  return answer.status === 204 ? (null as T) : ((await answer.json()) as T);
}

/** Downloads a file. */
export async function download(path: string): Promise<Blob> {
  return (await reach(path)).blob();
}

/** Converts a texture in KTX2 to a PNG. */
export async function decode(texture: Blob): Promise<Blob> {
  return (await reach("v1/decode", { method: "POST", headers: { "content-type": "image/ktx2" }, body: texture })).blob();
}

/** Connection to the service: set while it answers. Listeners are told of changes. */
export const connection = {
  isUp: true,
  changed: (_isUp: boolean): void => {},
  set(isUp: boolean): void {
    if (isUp === this.isUp) return;
    this.isUp = isUp;
    this.changed(isUp);
  },
};

/** Error of a request without an answer. */
export class Unanswered extends Error {
  constructor() {
    super("The service does not answer. Check that it runs, then try again.");
    connection.set(false);
  }
}

async function reach(path: string, request: RequestInit = {}): Promise<Response> {
  let answer: Response;
  try {
    answer = await fetch(address(path), request);
  } catch (error) {
    throw request.signal?.aborted ? error : new Unanswered();
  }
  connection.set(true);
  if (answer.ok) return answer;
  if (answer.status === 401) {
    await signIn();
    return reach(path, request);
  }
  throw refusal(answer.status, (await answer.json().catch(() => null)) as Problem | null);
}

function refusal(status: number, problem: Problem | null): Error {
  return problem ? new Refused(problem) : new Error(`The service answered with status ${status}.`);
}

/** Progress of an upload, and the signal that ends it. */
export interface Upload {
  progressed: (sent: number, total: number) => void;
  signal: AbortSignal;
}

/** An upload that nobody watches. */
const UNWATCHED: Upload = { progressed: () => {}, signal: new AbortController().signal };

/** Posts a form. `fetch` does not say how much of it has been sent. Throws an `AbortError` if the upload was cancelled. */
async function upload<T>(path: string, form: FormData, { progressed, signal }: Upload): Promise<T> {
  const request = new XMLHttpRequest();
  request.open("POST", address(path));
  request.responseType = "json";
  request.upload.onprogress = ({ loaded, total }) => progressed(loaded, total);
  await new Promise<void>((done, failed) => {
    request.onload = () => done();
    request.onerror = () => failed(new Unanswered());
    request.onabort = () => failed(signal.reason);
    signal.addEventListener("abort", () => request.abort());
    signal.throwIfAborted();
    request.send(form);
  });
  connection.set(true);
  if (request.status === 401) {
    await signIn();
    return upload(path, form, { progressed, signal });
  }
  if (400 <= request.status) throw refusal(request.status, request.response as Problem | null);
  return request.response as T;
}

/** Fetches the next frame of relaxing charts, or returns why there is none. */
export async function maps(job: Job, after: string, signal: AbortSignal): Promise<ArrayBuffer | "none" | "elsewhere"> {
  const answer = await reach(`${job.links.self}/maps?after=${after}`, { signal }).catch((error: unknown) => {
    if (error instanceof Refused && error.problem.code === "computed_elsewhere") return null;
    throw error;
  });
  if (!answer) return "elsewhere";
  return answer.status === 204 ? "none" : answer.arrayBuffer();
}

export const jobPath = (id: string) => `v1/jobs/${encodeURIComponent(id)}`;

/** An input with the files that it references. */
interface Input { name: string; content: Blob; resources: Map<string, Blob> }

/** What goes with the input of a job: its gates, and what is noted of it. */
interface Handling { accept?: string; metadata?: Record<string, unknown>; sending?: Upload }

/** Submits a file with the files that it references as a job. */
export function createJob(kind: string, options: Record<string, unknown>, { name, content, resources }: Input, { accept = "", metadata = {}, sending = UNWATCHED }: Handling = {}): Promise<Job> {
  const form = new FormData();
  form.append("kind", kind);
  form.append("options", JSON.stringify(options));
  if (accept) form.append("accept", accept);
  if (Object.keys(metadata).length) form.append("metadata", JSON.stringify(metadata));
  form.append("mesh", content, name);
  if (["gltf", "obj"].includes(extension(name))) for (const [path, blob] of resources) form.append("resource", blob, path);
  return upload<Job>("v1/jobs", form, sending);
}

/** Submits the input of another job with other options. */
export function createJobFrom({ id }: Job, kind: string, options: Record<string, unknown>, accept: string | null = null): Promise<Job> {
  const query = new URLSearchParams({ job: id, kind, ...(accept && { accept }) });
  for (const [name, value] of Object.entries(options)) query.set(name, typeof value === "string" ? value : JSON.stringify(value));
  return call<Job>(`v1/jobs?${query}`, { method: "POST" });
}

/** Returns the name of the batch that a job belongs to: that of the jobs of files that were chosen together. */
export function batchOf(job: Job | null): string | null {
  const { batch } = job?.metadata ?? {};
  return typeof batch === "string" ? batch : null;
}

export function isFinal(state: Job["state"]): boolean {
  return state !== "queued" && state !== "running";
}

/** Returns the file of a job's result with this role, the last part of its address. */
export function fileOf(job: Job, role: string): FileLink | undefined {
  return job.links.files.find(({ href }) => href.endsWith(`/${role}`));
}

/** Watches a job until it ends. Returns a function that stops. */
export function watch(job: Job, heard: (event: Progress) => void): () => void {
  let isOver = false;
  let last = 0;
  let socket: WebSocket;
  const connect = () => {
    const url = new URL(`${address(job.links.events)}?after=${last}`, document.baseURI);
    url.protocol = url.protocol.replace("http", "ws");
    socket = new WebSocket(url);
    socket.onmessage = ({ data }: MessageEvent<string>) => {
      const event = JSON.parse(data) as Progress;
      last = event.seq;
      isOver ||= isFinal(event.state);
      heard(event);
    };
    socket.onclose = () => {
      // A request tells whether the service is gone, or the socket alone.
      if (!isOver) void call("readyz").catch(() => {});
      if (!isOver) setTimeout(() => isOver || connect(), 1000);
    };
  };
  connect();
  return () => {
    isOver = true;
    socket.close();
  };
}

/** Waits for the end of a job and returns it; throws if it has not succeeded. */
export async function outcomeOf(job: Job): Promise<Job> {
  if (!isFinal(job.state)) {
    await new Promise<void>((over) => {
      const stop = watch(job, ({ state }) => {
        if (!isFinal(state)) return;
        stop();
        over();
      });
    });
  }
  const last = await call<Job>(job.links.self);
  if (last.state !== "succeeded") throw last.error ? new Refused(last.error) : new Error(`The job was ${last.state}.`);
  return last;
}
