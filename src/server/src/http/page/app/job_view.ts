// One job on the page: watched while it runs, shown when it has ended.

import { address, call, createJobFrom, fileOf, isFinal, type Job, jobPath, type Progress, watch } from "./api";
import { byId, element } from "./dom";
import type { Place } from "./address";
import { chosenOptions } from "./definitions";
import { percent } from "./format";
import { ProgressPanel, showEnded } from "./inspector";
import { doing } from "./outcome";
import { inputOf, type Shape, shapeOf } from "./kinds";
import type { JobList } from "./job_list";
import type { Report } from "./reports";
import type { Setup } from "./setup";
import type { Source } from "./source";
import { type Chosen, modelOfJob, type Store } from "./store";
import type { Viewer } from "./viewer";
import { watchCharts } from "./watching";

/** Parts of the page that a job view uses. */
export interface Parts {
  store: Store;
  viewer: Viewer;
  list: JobList;
  setup: Setup;
  failed: (error: unknown) => void;
  /** Callbacks for the end of the job, and its removal. */
  ended: () => void;
  removed: () => void;
  /** Callback for a job that was made of the shown one. */
  made: (job: Job, input: Chosen | null) => void;
}

/** Shows one job at a time. */
export class JobView {
  readonly #parts: Parts;
  #stop: () => void = () => {};
  /** Takes an event of the running job that is shown. */
  #heard: (event: Progress) => void = () => {};
  /** Inputs that were uploaded from here. */
  readonly #inputs = new Map<string, Chosen>();
  /** Jobs submitted here, as the service first described them, until they are opened. */
  readonly #made = new Map<string, Job>();
  /** The UVs that the views were last asked to show. */
  #uvs: Place["uvs"] = "after";

  constructor(parts: Parts) {
    this.#parts = parts;
    parts.store.show(() => this.#follow());
  }

  remember(job: Job, input: Chosen | null): void {
    if (input) this.#inputs.set(job.id, input);
    this.#made.set(job.id, job);
  }

  /** Takes the state of the shown job from a list, in case its events do not come through. */
  listed(jobs: Job[]): void {
    const job = jobs.find(({ id }) => id === this.#parts.store.job?.id);
    if (job) this.#heard(job);
  }

  /** The shown job with what is known of it, if it is this one. */
  #shown(job: Job) {
    const { subject } = this.#parts.store.state;
    return subject.kind === "job" && subject.job === job ? subject : null;
  }

  /** Adds what has become known of the shown job. */
  #learn(job: Job, facts: { report?: Report | null; input?: Chosen | null }): void {
    const subject = this.#shown(job);
    if (subject) this.#parts.store.change({ subject: { ...subject, ...facts } });
  }

  /** Stops watching a job. */
  leave(): void {
    this.#stop();
    this.#stop = () => {};
    this.#heard = () => {};
    showFallback(null);
  }

  async open(id: string): Promise<void> {
    const { store, viewer } = this.#parts;
    this.leave();
    if (store.job?.id !== id) viewer.calm();
    // Watch a new job with the facts that are known of it, so that its first charts are not missed.
    const made = this.#made.get(id);
    this.#made.delete(id);
    const job = made ?? (await call<Job>(jobPath(id)));
    this.#parts.list.take(job);
    if (store.place.job !== id) return;
    const { subject } = store.state;
    const input = this.#inputs.get(id) ?? (subject.kind === "job" && subject.job.id === id ? subject.input : null);
    store.change({ subject: { kind: "job", job, report: null, input } });
    if (isFinal(job.state)) return this.#ended(job);
    const panel = new ProgressPanel(job, this.#actions(job));
    note(awaited(job, job));
    void this.#showInput(job);
    let [now, isElsewhere]: [Progress, boolean] = [job, false];
    const stopCharts = watchCharts(job, viewer, () => {
      isElsewhere = true;
      // The next event may be long in coming.
      if (this.#shown(job) && !isFinal(now.state)) note(awaited(job, now, isElsewhere));
    });
    let last = job.seq - 1;
    this.#heard = (event) => {
      if (!this.#shown(job) || event.seq <= last) return;
      [last, now] = [event.seq, event];
      panel.show(event);
      this.#parts.list.heard(id, event);
      if (!viewer.isRelaxing) note(awaited(job, event, isElsewhere));
      if (!isFinal(event.state)) return;
      void this.open(id).catch(this.#parts.failed);
      // Another job may have started in its place.
      void this.#parts.list.refresh();
    };
    const stopEvents = watch(job, (event) => this.#heard(event));
    this.#stop = () => {
      stopCharts();
      stopEvents();
    };
  }

  async #inputFor(job: Job): Promise<Chosen | null> {
    return this.#shown(job)?.input ?? (await inputOf(job).catch(() => null));
  }

  async #showInput(job: Job): Promise<void> {
    const input = await this.#inputFor(job);
    if (!this.#shown(job) || !input) return;
    this.#learn(job, { input });
    await this.#parts.viewer.show({ ...input, model: modelOfJob(job), isTurning: true, isInput: true }).catch(() => {});
  }

  async #ended(job: Job): Promise<void> {
    const report = job.state === "succeeded" && fileOf(job, "report") ? await call<Report>(`${job.links.self}/report`) : null;
    if (!this.#shown(job)) return;
    this.#learn(job, { report });
    this.#parts.ended();
    await showEnded(job, report, this.#actions(job));
    const input = await this.#inputFor(job);
    if (!this.#shown(job)) return;
    this.#learn(job, { input });
    this.#uvs = this.#parts.store.place.uvs;
    if (job.state !== "succeeded") {
      this.#parts.viewer.calm();
      note(job.state === "failed" ? "No result: the job failed. The cause is beside." : "No result: the job was cancelled.");
      if (input) await this.#parts.viewer.show({ ...input, model: modelOfJob(job) }).catch(() => {});
      else this.#parts.viewer.clear();
      return;
    }
    await this.#showUvs(job);
  }

  /** Shows the other UVs of the job when the state says so. */
  #follow(): void {
    const { store, failed } = this.#parts;
    const { job } = store;
    if (!job || store.place.uvs === this.#uvs || !this.before()) return;
    this.#uvs = store.place.uvs;
    void this.#showUvs(job).catch(failed);
  }

  /** Shows the UVs that the job made, or those that its input had. */
  async #showUvs(job: Job): Promise<void> {
    const { store, viewer } = this.#parts;
    const source = store.place.uvs === "after" ? null : this.before();
    if (store.place.uvs !== "both") await viewer.showBeside(null);
    if (source && store.place.uvs === "before") {
      if (await viewer.show(source)) note(viewer.analysis?.atlases.some(({ isMapped }) => isMapped) ? "" : "The input has no UVs.");
      return;
    }
    const subject = this.#shown(job);
    if (subject) await this.#showShape(job, await shapeOf(job, subject.report, subject.input));
    if (source && this.#shown(job) && store.place.uvs === "both") await viewer.showBeside(source);
  }

  async #showShape(job: Job, shape: Shape): Promise<void> {
    if (!this.#shown(job)) return;
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

  /** Returns the input with its own UVs, to be judged like the result. */
  before(): Source | null {
    const { subject } = this.#parts.store.state;
    if (subject.kind !== "job" || !subject.input || !subject.report) return null;
    const { job, input, report } = subject;
    const { padding = 0, resolution = 1024, group_by, source_texcoord } = job.options;
    const by = (report.options?.group_by ?? group_by ?? "material") as "material";
    return { ...input, model: modelOfJob(job), record: { padding: Number(padding), resolution: resolution as number, group_by: by, texcoord: Number(source_texcoord ?? 0) } };
  }

  #actions(job: Job) {
    const { store, failed, list, setup, removed, made } = this.#parts;
    const wish = (does: Promise<unknown>) => void does.then(() => list.refresh()).catch(failed);
    return {
      cancel: () => wish(call(address(job.links.self), { method: "DELETE" })),
      finish: async () => {
        await call(`${job.links.self}/finish`, { method: "POST" }).catch((error: unknown) => {
          failed(error);
          throw error;
        });
      },
      again: (more: Record<string, boolean>) => wish(againOf(job, more).then((next) => made(next, this.#shown(job)?.input ?? null))),
      retry: () => wish(call(`${job.links.self}/retry`, { method: "POST" }).then(() => this.open(job.id))),
      remove: () => {
        list.remove(job);
        removed();
      },
      reuse: () => void setup.take(job.kind, job.options).catch(failed),
      position: () => list.position(job.id),
      noted: (saving: Promise<void>) => void saving.then(() => {
        list.rename(job);
        store.change({});
      }).catch(failed),
    };
  }
}

/** Runs a job again with other options in addition to its own. */
async function againOf(job: Job, more: Record<string, boolean>): Promise<Job> {
  return createJobFrom(job, job.kind, { ...(await chosenOptions(job.kind, job.options)), ...more }, job.accept);
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
  holder.replaceChildren(element("p", { textContent: why }), ...pictures.map(({ href, name }) => element("img", { src: address(href), alt: name, className: "drawn" })));
}

function showPictures(pictures: [string, string][]): void {
  const holder = byId("fallback");
  holder.hidden = false;
  holder.replaceChildren(...pictures.map(([src, caption]) => element("figure", {}, element("img", { src, alt: caption }), element("figcaption", { textContent: caption }))));
}
