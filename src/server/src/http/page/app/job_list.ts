// The list of jobs, with pictures, states and positions in the queue.

import { address, call, connection, fileOf, isFinal, type Job, type Progress } from "./api";
import { button, byId, element } from "./dom";
import { ago, duration, percent, plain } from "./format";
import { fragmentOf, START } from "./address";
import { JobFilters } from "./job_filters";
import { nameOf, tagsOf, titleOf } from "./notes";
import { doing, outcome, OUTCOMES } from "./outcome";
import type { Store } from "./store";

const PAGE = 20;
/** Intervals at which the list is fetched: while a job may change, and otherwise. Shorter ones mean more requests. */
const BUSY_MS = 1500;
const IDLE_MS = 15000;

/** Time for which a removed job can be brought back: the longest that Material Design shows a message with an action. */
const UNDO_MS = 10_000;

/** The list on the left. */
export class JobList {
  #jobs: Job[] = [];
  #next: string | null = null;
  #queue: string[] = [];
  #timer = 0;
  /** Set once the service has listed its jobs. */
  #isKnown = false;
  /** The job that the list marks. */
  #current: string | null = null;
  /** Number of changes of the filters, by which late responses are recognized and dropped. */
  #filterings = 0;
  readonly #filters = new JobFilters(() => {
    this.#filterings++;
    this.#jobs = [];
    this.#next = null;
    void this.refresh();
  });

  /** A job that is removed unless someone brings it back, and the timer of that. */
  #removed: { job: Job; timer: number } | null = null;

  /** `listed` receives the jobs of each answer. */
  constructor(readonly store: Store, readonly chosen: (id: string) => void, readonly listed: (jobs: Job[]) => void) {
    addEventListener("pagehide", () => this.#removeNow());
    byId("older").addEventListener("click", () => void this.#older());
    store.show(() => this.#current !== store.place.job && this.#show());
    document.addEventListener("visibilitychange", () => document.hidden || void this.refresh());
  }

  /** Asks the service for the newest jobs. */
  async refresh(): Promise<void> {
    clearTimeout(this.#timer);
    const filterings = this.#filterings;
    try {
      const page = await this.#page(null);
      if (filterings !== this.#filterings) return;
      const older = this.#jobs.filter((job) => PAGE <= page.jobs.length && !page.jobs.some(({ id }) => id === job.id) && job.created_at < page.jobs.at(-1)!.created_at);
      if (!older.length) this.#next = page.next;
      // Events may be ahead of the answer.
      const known = new Map(this.#jobs.map((job) => [job.id, job]));
      const latest = page.jobs.map((job) => (job.seq < (known.get(job.id)?.seq ?? 0) ? known.get(job.id)! : job));
      this.#jobs = [...latest, ...older];
      this.#isKnown = true;
      this.listed(this.#jobs);
      this.#queue = page.jobs.some(({ state }) => state === "queued") ? await queue() : [];
      this.#show();
    } catch {
      // Keep the list; the next request may succeed.
    }
    const isBusy = !connection.isUp || this.#jobs.some(({ state }) => !isFinal(state));
    if (!document.hidden) this.#timer = setTimeout(() => void this.refresh(), isBusy ? BUSY_MS : IDLE_MS);
  }

  /** Returns the position in the queue, from 1, or null. */
  position(id: string): number | null {
    const at = this.#queue.indexOf(id);
    return 0 <= at ? at + 1 : null;
  }

  /** Returns a listed job. */
  find(id: string | null): Job | null {
    return this.#jobs.find((job) => job.id === id) ?? null;
  }

  /** Lists a job that was made here, until the service lists it. */
  add(job: Job): void {
    this.#jobs = [job, ...this.#jobs];
    this.#show();
  }

  /** Shows what a job's events say, so that list and panel agree. */
  heard(id: string, event: Progress): void {
    // Events do not say what was proven: an ended job is asked for.
    if (isFinal(event.state)) return;
    this.#jobs = this.#jobs.map((job) => (job.id === id && job.seq < event.seq ? { ...job, ...event } : job));
    this.#show();
  }

  /** Shows a job as it was just fetched. */
  take(job: Job): void {
    this.#jobs = this.#jobs.map((listed) => (listed.id === job.id && listed.seq <= job.seq ? job : listed));
    this.#show();
  }

  /** Shows the name and the tags of a job that were changed here. */
  rename({ id, metadata }: Job): void {
    this.#jobs = this.#jobs.map((job) => (job.id === id ? { ...job, metadata } : job));
    this.#show();
  }

  /** Removes a job after a while in which it can be brought back. */
  remove(job: Job): void {
    this.#removeNow();
    this.#removed = { job, timer: setTimeout(() => this.#removeNow(), UNDO_MS) };
    const undo = button("Undo", () => {
      clearTimeout(this.#removed?.timer);
      this.#removed = null;
      byId("removed").hidden = true;
      this.#show();
      this.chosen(job.id);
    });
    byId("removed").replaceChildren(element("span", { textContent: `${titleOf(job)} is deleted, with its files.` }), undo);
    byId("removed").hidden = false;
    this.#show();
  }

  #removeNow(): void {
    const { job, timer } = this.#removed ?? {};
    if (!job) return;
    clearTimeout(timer);
    this.#removed = null;
    byId("removed").hidden = true;
    this.#jobs = this.#jobs.filter(({ id }) => id !== job.id);
    void call(address(job.links.self), { method: "DELETE", keepalive: true }).catch(() => {}).then(() => this.refresh());
  }

  async #older(): Promise<void> {
    const filterings = this.#filterings;
    const page = await this.#page(this.#next);
    if (filterings !== this.#filterings) return;
    this.#jobs.push(...page.jobs);
    this.#next = page.next;
    this.#show();
  }

  /** Asks for jobs from a cursor on. */
  #page(cursor: string | null): Promise<{ jobs: Job[]; next: string | null }> {
    return call(`v1/jobs?limit=${PAGE}${this.#filters.query()}${cursor === null ? "" : `&cursor=${cursor}`}`);
  }

  #show(): void {
    this.#current = this.store.place.job;
    const list = byId("job-list");
    const shown = new Map([...list.children].map((row) => [(row as HTMLElement).dataset.id, row as HTMLElement]));
    const shownJobs = this.#jobs.filter(({ id }) => id !== this.#removed?.job.id);
    list.replaceChildren(...shownJobs.map((job) => {
      const old = shown.get(job.id);
      const key = JSON.stringify([outcome(job), job.state, job.stage, Math.round(job.fraction * 100), this.position(job.id), this.#current === job.id, ago(job.created_at), nameOf(job), tagsOf(job)]);
      return old?.dataset.key === key ? old : this.#row(job, key);
    }));
    const none = this.#filters.isAny ? "No job meets the filter." : "None yet. Press Unwrap to make one of the sample.";
    if (!shownJobs.length && this.#isKnown) list.replaceChildren(element("li", { className: "none", textContent: none }));
    byId("older").hidden = this.#next === null;
  }

  #row(job: Job, key: string): HTMLElement {
    const link = element("a", { href: `#${fragmentOf({ ...START, job: job.id })}`, className: "row-link" },
      thumbnail(job),
      element("span", { className: "name", title: [nameOf(job), ...tagsOf(job)].join(" · ") }, titleOf(job), ...tagsOf(job).map((tag) => element("small", { className: "tag", textContent: tag }))),
      element("span", { className: `facts ${outcome(job)}${job.accepted === false ? " refused" : ""}`, textContent: this.#facts(job) }));
    if (job.id === this.#current) link.setAttribute("aria-current", "true");
    link.addEventListener("click", (event) => {
      event.preventDefault();
      this.chosen(job.id);
    });
    const bar = element("progress", { max: 1, value: job.fraction, hidden: job.state !== "running", aria: { label: `Progress of ${titleOf(job)}` } });
    return element("li", { data: { id: job.id, key } }, link, bar);
  }

  #facts(job: Job): string {
    const kind = job.kind === "unwrap" ? "" : `${plain(job.kind)} · `;
    if (job.state === "queued") {
      const position = this.position(job.id);
      return `${kind}${position ? `number ${position} in the queue` : "queued"}`;
    }
    if (job.state === "running") return `${kind}${doing(job)} · ${percent(job.fraction)}`;
    const gates = job.accepted === false ? " · not accepted" : "";
    return `${kind}${OUTCOMES[outcome(job)]}${gates} · ${duration(job.elapsed_ms)} · ${ago(job.created_at)}`;
  }
}

/** Returns the waiting jobs in the order in which they start. */
async function queue(): Promise<string[]> {
  const { jobs } = await call<{ jobs: Job[] }>("v1/jobs?state=queued&limit=200");
  const order = (one: Job, other: Job) => other.priority - one.priority || one.created_at.localeCompare(other.created_at);
  return jobs.sort(order).map(({ id }) => id);
}

/** Shown in place of a missing picture. */
const NO_PICTURE = "data:image/gif;base64,R0lGODlhAQABAAAAACH5BAEKAAEALAAAAAABAAEAAAICTAEAOw==";

/** Creates the picture of a job, which is requested when it becomes visible. */
function thumbnail(job: Job): HTMLImageElement {
  const made = fileOf(job, "thumbnail.png");
  // A warped picture is no drawing, and looks alike in the dark.
  const className = job.kind === "warp" ? "" : "drawn";
  const image = element("img", { width: 36, height: 36, alt: "", loading: "lazy", className, src: made ? address(made.href) : NO_PICTURE });
  image.addEventListener("error", () => (image.src = NO_PICTURE), { once: true });
  return image;
}
