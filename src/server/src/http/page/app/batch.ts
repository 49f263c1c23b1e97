// The batch of the shown job, made of several files at once: a table of its jobs, pictures of their layouts, and all results in
// one file.

import { stretchOf } from "../analysis/distortion";
import { zipSync } from "three/addons/libs/fflate.module.js";
import { address, batchOf, call, download, fileOf, isFinal, type Job } from "./api";
import { fragmentOf } from "./address";
import { button, byId, element } from "./dom";
import { counted, duration, percent, plain, short, whole } from "./format";
import { nameOf } from "./notes";
import { doing, outcome, OUTCOMES } from "./outcome";
import { type Figures, figuresOf, type Report } from "./reports";
import { elsewhere, type Store } from "./store";

/** Maximum number of jobs that are asked for at once: that of the service. */
const MOST = 200;

/** Time between two looks at a batch with jobs that have not ended, in milliseconds. */
const BETWEEN_LOOKS_MS = 3_000;

/** Reports that are fetched at once. Browsers open six connections to a service, and the page needs some. */
const READERS = 4;

/** A job of the batch; figures are null until it has succeeded and its report is read. */
interface Row {
  job: Job;
  figures: Figures | null;
}

/** A column: its text for a job, and what it is sorted by, in which text comes before what is missing. */
interface Column {
  key: string;
  title: string;
  help?: string;
  text: (row: Row) => string;
  by: (row: Row) => string | number | null;
  /** Text in the last row. */
  total: (rows: Row[]) => string;
}

const sum = (numbers: (number | undefined)[]) => numbers.reduce<number>((total, x) => total + (x ?? 0), 0);
const measured = (rows: Row[]) => rows.flatMap(({ figures }) => figures ?? []);

/** Returns the mean of a figure over the jobs that have it, in words. */
function mean(rows: Row[], of: (figures: Figures) => number): string {
  const all = measured(rows);
  return all.length ? `${percent(sum(all.map(of)) / all.length)} mean` : "–";
}

const COLUMNS: Column[] = [
  { key: "name", title: "Name", text: ({ job }) => nameOf(job), by: ({ job }) => nameOf(job).toLowerCase(), total: (rows) => counted(rows.length, "job") },
  { key: "state", title: "State", text: ({ job }) => stateOf(job), by: ({ job }) => `${outcome(job)} ${job.state}`, total: (rows) => summary(rows) },
  { key: "faces", title: "Faces", text: ({ figures }) => (figures ? whole(figures.faces) : "–"), by: ({ figures }) => figures?.faces ?? null, total: (rows) => whole(sum(measured(rows).map(({ faces }) => faces))) },
  { key: "charts", title: "Charts", text: ({ figures }) => (figures ? whole(figures.charts) : "–"), by: ({ figures }) => figures?.charts ?? null, total: (rows) => whole(sum(measured(rows).map(({ charts }) => charts))) },
  { key: "stretch", title: "Stretch", help: "By how much lengths are stretched or compressed on average, from the symmetric Dirichlet energy", text: ({ figures }) => (figures ? percent(stretch(figures)) : "–"), by: ({ figures }) => figures?.energy ?? null, total: (rows) => mean(rows, stretch) },
  { key: "energy", title: "Energy", help: "Mean symmetric Dirichlet energy; an isometry has 4", text: ({ figures }) => short(figures?.energy), by: ({ figures }) => figures?.energy ?? null, total: () => "" },
  { key: "fill", title: "Fill", help: "Share of the texture that charts cover", text: ({ figures }) => (figures ? percent(figures.fill) : "–"), by: ({ figures }) => figures?.fill ?? null, total: (rows) => mean(rows, ({ fill }) => fill) },
  { key: "notes", title: "Gates and warnings", text: ({ job }) => notes(job).join(", "), by: ({ job }) => notes(job).length || null, total: accepted },
  { key: "time", title: "Time", text: ({ job }) => duration(job.elapsed_ms), by: ({ job }) => job.elapsed_ms, total: (rows) => duration(sum(rows.map(({ job }) => job.elapsed_ms))) },
];

const stretch = ({ energy }: Figures) => stretchOf("sym-dirichlet", energy);

function stateOf(job: Job): string {
  if (job.state === "queued") return "queued";
  return job.state === "running" ? `${doing(job)} · ${percent(job.fraction)}` : OUTCOMES[outcome(job)];
}

/** Returns what a person has to look at: the error, the gates and the warnings of a job. */
function notes({ error, accepted, accept, warnings }: Job): string[] {
  return [...(error ? [error.title] : []), ...(accepted === null ? [] : [accepted ? `meets ${accept}` : `misses ${accept}`]), ...warnings.map(({ code }) => plain(code))];
}

/** Counts the jobs that meet their gates. */
function accepted(rows: Row[]): string {
  const judged = rows.filter(({ job }) => job.accepted !== null);
  return judged.length ? `${judged.filter(({ job }) => job.accepted).length} of ${judged.length} accepted` : "";
}

/** Counts the jobs by what has come of them. */
function summary(rows: Row[]): string {
  const counts = new Map<string, number>();
  for (const { job } of rows) {
    const word = isFinal(job.state) ? OUTCOMES[outcome(job)] : job.state;
    counts.set(word, (counts.get(word) ?? 0) + 1);
  }
  return [...counts].map(([word, count]) => `${count} ${word}`).join(", ");
}

/** Sorts rows by a column, as they were made without one. What is missing comes last in either order. */
function sorted(rows: Row[], sort: string): Row[] {
  const [, sign, key] = /^(-?)(.*)$/.exec(sort)!;
  const column = COLUMNS.find((one) => one.key === key);
  if (!column) return rows;
  const order = sign ? -1 : 1;
  return rows.toSorted((row, other) => {
    const [a, b] = [column.by(row), column.by(other)];
    if (a === null || b === null) return Number(a === null) - Number(b === null);
    return order * (typeof a === "string" ? a.localeCompare(String(b)) : a - Number(b));
  });
}

/** The tab of the batch. */
export class BatchView {
  #batch: string | null = null;
  #jobs: Job[] = [];
  readonly #figures = new Map<string, Figures | null>();
  /** Set while the tab is shown. */
  #isFollowing = false;
  /** Timer of the next look; null if none is to come. */
  #timer: number | null = null;
  /** Number of jobs that were added here, by which lists without them are recognized and dropped. */
  #added = 0;
  /** What is on the page, so that nothing is replaced that has not changed. */
  #key = "";
  /** Number of results that are in the ZIP that is being made; null without one. */
  #zipped: number | null = null;

  constructor(readonly store: Store, readonly told: { open: (id: string) => void; failed: (error: unknown) => void }) {
    store.show(() => this.follow());
  }

  /** Follows the batch of the shown job while its tab is shown. */
  follow(): void {
    const { place } = this.store;
    const batch = batchOf(this.store.job);
    const isNew = batch !== this.#batch;
    if (isNew) [this.#batch, this.#jobs] = [batch, []];
    const wasFollowing = this.#isFollowing;
    this.#isFollowing = place.tab === "batch" && batch !== null;
    if (!this.#isFollowing) return this.#plan(null);
    if (isNew || !wasFollowing) void this.#look();
    this.#show();
  }

  /** Adds a job that was just made. */
  add(job: Job): void {
    if (batchOf(job) !== this.#batch) return;
    this.#added++;
    this.#jobs.push(job);
    if (this.#timer === null) this.#plan(BETWEEN_LOOKS_MS);
    this.#show();
  }

  /** Takes the states of jobs from a list. */
  listed(jobs: Job[]): void {
    const latest = new Map(jobs.map((job) => [job.id, job]));
    this.#jobs = this.#jobs.map((job) => (job.seq < (latest.get(job.id)?.seq ?? 0) ? latest.get(job.id)! : job));
    if (this.#timer === null && this.#jobs.some(({ state }) => !isFinal(state))) this.#plan(BETWEEN_LOOKS_MS);
    this.#show();
  }

  /** Looks again after a while, or not any more. */
  #plan(delay: number | null): void {
    if (this.#timer !== null) clearTimeout(this.#timer);
    this.#timer = delay === null || !this.#isFollowing ? null : window.setTimeout(() => void this.#look(), delay);
  }

  /** Asks for the jobs of the batch and their figures, again and again until all have ended. */
  async #look(): Promise<void> {
    const [batch, added] = [this.#batch, this.#added];
    this.#plan(null);
    if (batch === null) return;
    const jobs = await jobsOf(batch).catch(() => null);
    if (batch !== this.#batch) return;
    if (added !== this.#added) return this.#plan(BETWEEN_LOOKS_MS);
    if (jobs) this.#jobs = jobs;
    this.#show();
    if (!jobs || jobs.some(({ state }) => !isFinal(state))) this.#plan(BETWEEN_LOOKS_MS);
    await this.#read(batch);
  }

  /** Reads the reports that are not known yet. */
  async #read(batch: string): Promise<void> {
    const unread = this.#jobs.filter(({ id, state }) => state === "succeeded" && !this.#figures.has(id));
    const reader = async () => {
      for (let job = unread.shift(); job && batch === this.#batch; job = unread.shift()) {
        const report = fileOf(job, "report") ? await call<Report>(`${job.links.self}/report`).catch(() => null) : null;
        this.#figures.set(job.id, figuresOf(report));
        this.#show();
      }
    };
    await Promise.all(Array.from({ length: READERS }, reader));
  }

  #show(): void {
    const { place, refused } = this.store.state;
    if (place.tab !== "batch" || this.#batch === null) return;
    const missing = refused?.batch === this.#batch ? refused.files : [];
    const rows = sorted(this.#jobs.map((job) => ({ job, figures: this.#figures.get(job.id) ?? null })), place.sort);
    const key = JSON.stringify([this.#batch, place.sort, place.sheet, place.job, this.#zipped, missing, rows.map(({ job, figures }) => [job.id, job.seq, nameOf(job), figures])]);
    if (key === this.#key) return;
    this.#key = key;
    const focused = (document.activeElement as HTMLElement | null)?.dataset.focus;
    const tab = byId("batch");
    const { scrollTop } = tab;
    const ended = rows.filter(({ job }) => isFinal(job.state)).length;
    tab.replaceChildren(
      element("header", {}, element("h2", { textContent: counted(rows.length, "job") }), element("p", { aria: { role: "status" }, textContent: summary(rows) }),
        element("div", { className: "actions" }, this.#layouts(), ...this.#actions(rows))),
      element("progress", { max: rows.length || 1, value: ended, aria: { label: "Share of the jobs that have ended" } }),
      ...(missing.length ? [element("p", { className: "refused wrong", aria: { role: "alert" }, textContent: `${counted(missing.length, "file")} refused. ${missing.join(" ")}` })] : []),
      place.sheet ? this.#pictures(rows) : this.#table(rows));
    tab.scrollTop = scrollTop;
    if (focused) tab.querySelector<HTMLElement>(`[data-focus=${JSON.stringify(focused)}]`)?.focus();
  }

  #layouts(): HTMLElement {
    const choice = (text: string, sheet: boolean) => button(text, () => this.store.go({ sheet }), { data: { focus: text }, aria: { pressed: String(this.store.place.sheet === sheet) } });
    return element("div", { className: "tools", aria: { role: "group", label: "Show as" } }, choice("Table", false), choice("Contact sheet", true));
  }

  #actions(rows: Row[]): HTMLElement[] {
    const jobs = rows.map(({ job }) => job);
    const [live, failed, results] = [jobs.filter(({ state }) => !isFinal(state)), jobs.filter(({ state }) => state === "failed"), jobs.filter((job) => fileOf(job, "result"))];
    const metadata = new URLSearchParams({ metadata: JSON.stringify({ batch: this.#batch }) });
    const act = (text: string, does: () => Promise<unknown>) => button(text, () => void does().catch(this.told.failed).then(() => this.#look()));
    const zip = button(this.#zipped === null ? `Download ${counted(results.length, "result")} as ZIP` : `Fetching ${this.#zipped + 1} of ${results.length} …`, () => void this.#save(results).catch(this.told.failed), { className: "primary", data: { focus: "zip" } });
    zip.disabled = !results.length || this.#zipped !== null;
    return [
      zip,
      ...(failed.length ? [act(`Retry ${failed.length} failed`, () => call(`v1/jobs/retry?${metadata}`, { method: "POST" }))] : []),
      ...(live.length ? [act(`Cancel ${live.length}`, () => Promise.all(live.map(({ links }) => call(address(links.self), { method: "DELETE" }))))] : []),
    ];
  }

  /** Creates a link to a job in both views. */
  #link(job: Job, ...content: (Node | string)[]): HTMLElement {
    const { place } = this.store;
    const link = element("a", { href: `#${fragmentOf({ ...elsewhere(place), job: job.id })}`, title: nameOf(job), data: { focus: job.id } }, ...content);
    if (job.id === place.job) link.setAttribute("aria-current", "true");
    link.addEventListener("click", (event) => {
      event.preventDefault();
      this.told.open(job.id);
    });
    return link;
  }

  #table(rows: Row[]): HTMLElement {
    const { sort } = this.store.place;
    const heads = COLUMNS.map(({ key, title, help }) => {
      const next = sort === key ? `-${key}` : sort === `-${key}` ? "" : key;
      const made = button(`${title}${sort === key ? " ↑" : sort === `-${key}` ? " ↓" : ""}`, () => this.store.go({ sort: next }), { className: "bare", title: help ?? `Sort by ${title.toLowerCase()}`, data: { focus: `sort ${key}` } });
      return element("th", { scope: "col", className: key, aria: { sort: sort === key ? "ascending" : sort === `-${key}` ? "descending" : "none" } }, made);
    });
    const body = rows.map((row) => element("tr", { className: outcome(row.job), data: { id: row.job.id } },
      ...COLUMNS.map(({ key, text }) => (key === "name" ? element("th", { scope: "row" }, this.#link(row.job, text(row)))
        : element("td", { className: key, title: key === "notes" ? row.job.warnings.map(({ message }) => message).join("\n") : "", textContent: text(row) })))));
    const foot = element("tr", {}, ...COLUMNS.map(({ key, total }) => element(key === "name" ? "th" : "td", { className: key, textContent: total(rows) })));
    return element("div", { className: "scroll", tabIndex: 0, aria: { role: "region", label: "Jobs of the batch" } },
      element("table", {}, element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...body), element("tfoot", {}, foot)));
  }

  #pictures(rows: Row[]): HTMLElement {
    return element("ul", { className: "contact-sheet" }, ...rows.map(({ job, figures }) => {
      const layout = fileOf(job, "layout.png");
      const picture = layout ? element("img", { src: address(layout.href), alt: "", loading: "lazy", className: "drawn" }) : element("span", { className: "none", textContent: stateOf(job) });
      const facts = figures ? `${counted(figures.charts, "chart")} · ${percent(stretch(figures))} · ${percent(figures.fill)} full` : stateOf(job);
      return element("li", { className: outcome(job) }, this.#link(job, picture, element("span", { className: "name", textContent: nameOf(job) })),
        element("small", { textContent: facts }));
    }));
  }

  /** Saves the results of jobs, with the files that belong to them, as one ZIP. */
  async #save(jobs: Job[]): Promise<void> {
    const batch = this.#batch!;
    try {
      const files = await filesOf(jobs, (n) => {
        this.#zipped = n;
        this.#show();
      });
      const zip = new Blob([zipSync(files, { level: 0 })], { type: "application/zip" });
      const link = element("a", { href: URL.createObjectURL(zip), download: `${batch.replaceAll(":", "-")}.zip` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href));
    } finally {
      this.#zipped = null;
      this.#show();
    }
  }
}

/** Fetches all jobs of a batch in the order in which they were made. */
async function jobsOf(batch: string): Promise<Job[]> {
  const jobs: Job[] = [];
  for (let cursor: string | null = ""; cursor !== null;) {
    const query = new URLSearchParams({ limit: String(MOST), order: "oldest_first", metadata: JSON.stringify({ batch }), ...(cursor && { cursor }) });
    const page: { jobs: Job[]; next: string | null } = await call(`v1/jobs?${query}`);
    jobs.push(...page.jobs);
    cursor = page.next;
  }
  return jobs;
}

/** Fetches the results of jobs with the files that belong to them, in the folders of their inputs. A result of several files
 * has a folder; equal names are numbered. `begun` receives the number of results that are there. */
async function filesOf(jobs: Job[], begun: (count: number) => void): Promise<Record<string, Uint8Array>> {
  const files: Record<string, Uint8Array> = {};
  const taken = new Set<string>();
  for (const [count, job] of jobs.entries()) {
    begun(count);
    const own = job.links.files.filter(({ href }) => href.endsWith("/result") || href.includes("/files/"));
    const stem = `${nameOf(job).replace(/[^/]*$/, "")}${own[0]!.name.replace(/\.[^.]*$/, "")}`;
    const end = own[0]!.name.replace(/^.*(?=\.)/, "");
    let name = stem;
    for (let k = 2; taken.has(name); k++) name = `${stem}-${k}`;
    taken.add(name);
    for (const { href, name: file } of own) {
      files[own.length === 1 ? `${name}${end}` : `${name}/${file}`] = new Uint8Array(await (await download(href)).arrayBuffer());
    }
  }
  return files;
}
