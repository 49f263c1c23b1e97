// The jobs that were made of several files at once: their totals, and all their results in one file.

import { zipSync } from "three/addons/libs/fflate.module.js";
import { call, download, fileOf, isFinal, type Job } from "./api";
import { button, element, pairs } from "./dom";
import { counted, duration } from "./format";
import { outcome } from "./outcome";

/** Maximum number of jobs that are asked for at once: that of the service. */
const MOST = 200;

/** Time between two looks at the jobs of a batch that have not ended, in milliseconds. */
const BETWEEN_LOOKS = 3_000;

/** Returns the section of a job's batch, which follows its jobs until they have ended; null if it has none. */
export function batchOf({ metadata }: Job): HTMLElement | null {
  const { batch } = metadata;
  if (typeof batch !== "string") return null;
  const section = element("section", { className: "batch" });
  void follow(section, batch);
  return section;
}

/** Fills the section of a batch again and again while it is on the page and jobs of the batch have not ended. */
async function follow(section: HTMLElement, batch: string): Promise<void> {
  const jobs = await jobsOf(batch).catch(() => null);
  if (jobs) section.replaceChildren(element("h2", { textContent: "Batch" }), ...totals(jobs), zipButton(jobs, batch));
  if (jobs?.every(({ state }) => isFinal(state))) return;
  setTimeout(() => { if (section.isConnected) void follow(section, batch); }, BETWEEN_LOOKS);
}

async function jobsOf(batch: string): Promise<Job[]> {
  const query = new URLSearchParams({ limit: String(MOST), metadata: JSON.stringify({ batch }) });
  return (await call<{ jobs: Job[] }>(`v1/jobs?${query}`)).jobs.reverse();
}

function totals(jobs: Job[]): HTMLElement[] {
  const count = (word: string) => jobs.filter((job) => isFinal(job.state) && outcome(job) === word).length;
  const rows = [["Certified", count("certified")], ["Not certified", count("open")], ["Done", count("done")], ["Failed", count("failed")], ["Cancelled", count("cancelled")],
    ["Not ended", jobs.filter(({ state }) => !isFinal(state)).length]] as const;
  const time = jobs.reduce((sum, job) => sum + job.elapsed_ms, 0);
  return [pairs([["Jobs", String(jobs.length)], ...rows.filter(([, n]) => n).map(([name, n]): [string, string] => [name, String(n)]), ["Time in total", duration(time)]])];
}

function zipButton(jobs: Job[], batch: string): HTMLElement {
  const results = jobs.filter((job) => fileOf(job, "result"));
  const made = button(`Download ${counted(results.length, "result")} as ZIP`, () => void save().catch(() => (made.textContent = "Not all results can be fetched. Try again")));
  made.disabled = !results.length;
  async function save(): Promise<void> {
    const zip = new Blob([zipSync(await filesOf(results), { level: 0 })], { type: "application/zip" });
    const link = element("a", { href: URL.createObjectURL(zip), download: `${batch.replaceAll(":", "-")}.zip` });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href));
  }
  return made;
}

/** Fetches the results of jobs with the files that belong to them. A result of several files has a folder; folders and
 * files of equal names are numbered. */
async function filesOf(jobs: Job[]): Promise<Record<string, Uint8Array>> {
  const files: Record<string, Uint8Array> = {};
  const taken = new Set<string>();
  for (const job of jobs) {
    const own = job.links.files.filter(({ href }) => href.endsWith("/result") || href.includes("/files/"));
    const [stem, end] = [own[0]!.name.replace(/\.[^.]*$/, ""), own[0]!.name.replace(/^.*(?=\.)/, "")];
    let name = stem;
    for (let k = 2; taken.has(name); k++) name = `${stem}-${k}`;
    taken.add(name);
    for (const { href, name: file } of own) {
      files[own.length === 1 ? `${name}${end}` : `${name}/${file}`] = new Uint8Array(await (await download(href)).arrayBuffer());
    }
  }
  return files;
}
