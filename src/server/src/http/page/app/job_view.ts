// One job on the page: watched while it runs, shown when it has ended.

import { address, call, fileOf, isFinal, type Job, jobPath, type Progress, watch } from "./api";
import { byId, element } from "./dom";
import { percent } from "./format";
import { doing, ProgressPanel, showEnded } from "./inspector";
import { inputOf, type Shape, shapeOf } from "./kinds";
import type { JobList } from "./job_list";
import type { Report } from "./reports";
import type { Chosen, Setup } from "./setup";
import type { Source } from "./source";
import { nameShown } from "./title";
import type { Viewer } from "./viewer";
import { watchCharts } from "./watching";

/** Parts of the page that a job view uses. */
export interface Parts {
  viewer: Viewer;
  list: JobList;
  setup: Setup;
  failed: (error: unknown) => void;
  /** Callbacks for the end of the job, its removal, and the display of its result. */
  ended: () => void;
  removed: () => void;
  shown: () => void;
}

/** Shows one job at a time. */
export class JobView {
  job: Job | null = null;
  report: Report | null = null;
  input: Chosen | null = null;
  readonly #parts: Parts;
  #stop: () => void = () => {};
  /** Inputs that were uploaded from here. */
  readonly #inputs = new Map<string, Chosen>();
  /** Jobs submitted here, as the service first described them, until they are opened. */
  readonly #made = new Map<string, Job>();

  constructor(parts: Parts) {
    this.#parts = parts;
  }

  remember(job: Job, input: Chosen): void {
    this.#inputs.set(job.id, input);
    this.#made.set(job.id, job);
  }

  /** Stops showing a job. */
  leave(): void {
    this.#stop();
    this.job = this.report = this.input = null;
    showFallback(null);
  }

  async open(id: string): Promise<void> {
    const isOther = this.job?.id !== id;
    this.leave();
    if (isOther) this.#parts.viewer.calm();
    // Watch a new job with the facts that are known of it, so that its first charts are not missed.
    const made = this.#made.get(id);
    this.#made.delete(id);
    const job = made ?? (await call<Job>(jobPath(id)));
    this.job = job;
    nameShown(job.filename);
    if (isFinal(job.state)) return this.#ended(job);
    const panel = new ProgressPanel(job, this.#actions(job));
    note(awaited(job, job));
    void this.#showInput(job);
    let isElsewhere = false;
    const stopCharts = watchCharts(job, this.#parts.viewer, () => (isElsewhere = true));
    const stopEvents = watch(job, (event) => {
      if (this.job?.id !== id) return;
      panel.show(event);
      if (!this.#parts.viewer.isRelaxing) note(awaited(job, event, isElsewhere));
      if (isFinal(event.state)) void this.open(id).then(() => this.#parts.list.refresh()).catch(this.#parts.failed);
    });
    this.#stop = () => {
      stopCharts();
      stopEvents();
    };
  }

  async #inputFor(job: Job): Promise<Chosen | null> {
    return this.#inputs.get(job.id) ?? (await inputOf(job).catch(() => null));
  }

  async #showInput(job: Job): Promise<void> {
    const input = await this.#inputFor(job);
    if (this.job?.id !== job.id || !input) return;
    this.input = input;
    await this.#parts.viewer.show({ ...input, isTurning: true, isInput: true }).catch(() => {});
  }

  async #ended(job: Job): Promise<void> {
    const report = job.state === "succeeded" && fileOf(job, "report") ? await call<Report>(`${job.links.self}/report`) : null;
    if (this.job !== job) return;
    this.report = report;
    this.#parts.ended();
    await showEnded(job, report, this.#actions(job));
    this.input = await this.#inputFor(job);
    if (this.job !== job) return;
    if (job.state !== "succeeded") {
      this.#parts.viewer.calm();
      note(job.state === "failed" ? "No result: the job failed. The cause is beside." : "No result: the job was cancelled.");
      if (this.input) await this.#parts.viewer.show(this.input).catch(() => {});
      else this.#parts.viewer.clear();
      return this.#parts.shown();
    }
    await this.#showShape(job, await shapeOf(job, report, this.input));
    this.#parts.shown();
  }

  async #showShape(job: Job, shape: Shape): Promise<void> {
    if (this.job !== job) return;
    const { viewer } = this.#parts;
    note("surface" in shape ? "Looking at the result …" : "");
    if ("surface" in shape) {
      if (await viewer.show(shape.surface)) note(viewer.analysis?.atlases.some(({ isMapped }) => isMapped) ? "" : "This file has no UVs.");
      if (!viewer.stage) showFallback(job, "This browser shows no WebGL here: pictures instead of views.");
    } else {
      viewer.clear();
      if ("pictures" in shape) showPictures(shape.pictures);
      else note(shape.nothing);
    }
  }

  /** Shows the result again after the input. */
  async showResult(): Promise<void> {
    const { job, report } = this;
    if (job) await this.#showShape(job, await shapeOf(job, report, this.input));
  }

  /** Returns the input with its own UVs, to be judged like the result. */
  before(): Source | null {
    const { job, input } = this;
    if (!job || !input) return null;
    const { padding = 0, resolution = 1024, group_by, source_texcoord } = job.options;
    const by = (this.report?.options?.group_by ?? group_by ?? "material") as "material";
    return { ...input, record: { padding: Number(padding), resolution: resolution as number, group_by: by, texcoord: Number(source_texcoord ?? 0) } };
  }

  #actions(job: Job) {
    const { failed, list, setup, removed } = this.#parts;
    const wish = (does: Promise<unknown>) => void does.then(() => list.refresh()).catch(failed);
    const remove = () => call(address(job.links.self), { method: "DELETE" });
    return {
      cancel: () => wish(remove()),
      finish: () => wish(call(`${job.links.self}/finish`, { method: "POST" })),
      retry: () => wish(call(`${job.links.self}/retry`, { method: "POST" }).then(() => this.open(job.id))),
      remove: () => wish(remove().then(removed)),
      reuse: () => void setup.take(job.kind, job.options).catch(failed),
      position: () => list.position(job.id),
    };
  }
}

/** Returns the text to show until there are UVs. */
function awaited({ kind }: Job, now: Progress, isElsewhere = false): string {
  if (now.state === "queued") return "The job waits for its turn.";
  if (isFinal(now.state)) return `${doing(now)} …`;
  const then = isElsewhere ? "Another machine computes this job: its UVs appear here when it ends."
    : kind === "unwrap" ? "Charts appear here as soon as the first one is planned." : "The result appears here when the job ends.";
  return `${doing(now)}, ${percent(now.fraction)} done. ${then}`;
}

/** Shows a text in place of the UVs. */
export function note(text: string): void {
  byId("plane-note").textContent = text;
}

/** Shows the pictures of the service where WebGL is missing. */
export function showFallback(job: Job | null, why = ""): void {
  const holder = byId("fallback");
  const pictures = job ? job.links.files.filter(({ name }) => name.endsWith(".png") && name !== "thumbnail.png") : [];
  holder.hidden = job === null;
  holder.replaceChildren(element("p", { textContent: why }), ...pictures.map(({ href, name }) => element("img", { src: address(href), alt: name })));
}

function showPictures(pictures: [string, string][]): void {
  const holder = byId("fallback");
  holder.hidden = false;
  holder.replaceChildren(...pictures.map(([src, caption]) => element("figure", {}, element("img", { src, alt: caption }), element("figcaption", { textContent: caption }))));
}
