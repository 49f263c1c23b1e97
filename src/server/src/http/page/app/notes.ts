// The name and the tags of a job, which the service keeps in its metadata, beside what else was noted there.

import { call, type Job } from "./api";
import { element, pairs } from "./dom";

/** Returns the name that a person gave a job, or that of its file. */
export function titleOf({ filename, metadata }: Job): string {
  return typeof metadata.name === "string" ? metadata.name : filename;
}

/** Like `titleOf`, but with the path of the file in the folder or archive that it came in. */
export function nameOf(job: Job): string {
  const { name, path } = job.metadata;
  return typeof name !== "string" && typeof path === "string" ? path : titleOf(job);
}

/** Returns the tags of a job: members of its metadata that are just true, so that lists are filtered by each. */
export function tagsOf({ metadata }: Job): string[] {
  return Object.keys(metadata).filter((name) => metadata[name] === true);
}

/** Replaces the name and the tags of a job. The job keeps its identity, by which its views know it. */
export async function note(job: Job, name: string, tags: string[]): Promise<void> {
  const others = Object.entries(job.metadata).filter(([member, value]) => member !== "name" && value !== true);
  const metadata = { ...Object.fromEntries(others), ...(name && { name }), ...Object.fromEntries(tags.map((tag) => [tag, true])) };
  const query = new URLSearchParams({ metadata: JSON.stringify(metadata) });
  job.metadata = (await call<Job>(`${job.links.self}?${query}`, { method: "PATCH" })).metadata;
}

/** Creates the fields for name and tags, and shows what else is noted of a job. */
export function notesOf(job: Job, changed: (saving: Promise<void>) => void): HTMLElement[] {
  const name = element("input", { type: "text", id: "job-name", value: titleOf(job) === job.filename ? "" : titleOf(job), placeholder: job.filename });
  const tags = element("input", { type: "text", id: "job-tags", value: tagsOf(job).join(", "), placeholder: "hero, rocks", title: "Words with commas between them. They are members of the metadata: hero=true finds the job" });
  const save = () => changed(note(job, name.value.trim(), tags.value.split(",").map((tag) => tag.trim()).filter(Boolean)));
  for (const field of [name, tags]) field.addEventListener("change", save);
  const others = Object.entries(job.metadata).filter(([member, value]) => member !== "name" && value !== true);
  const row = (label: string, field: HTMLInputElement) => element("div", { className: "row" }, element("label", { htmlFor: field.id, textContent: label }), field);
  return [
    element("section", {}, element("h2", { textContent: "Name" }), row("Name", name), row("Tags", tags)),
    ...(others.length ? [element("section", {}, element("h2", { textContent: "Metadata" }), pairs(others.map(([member, value]) => [member, typeof value === "string" ? value : JSON.stringify(value)])))] : []),
  ];
}
