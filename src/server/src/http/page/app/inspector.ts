// The panel on the right: facts about the job, and actions on it.

import { address, isFinal, type Job, type Progress } from "./api";
import { chosenOptions } from "./definitions";
import { commandLine, copy, curl } from "./commands";
import { curve } from "./charts_svg";
import { button, byId, element, pairs, prose } from "./dom";
import { bytes, duration, percent, plain, sentence, short, whole } from "./format";
import { notesOf } from "./notes";
import { doing, outcome } from "./outcome";
import { left, Stages } from "./stages";
import { claimed, claims, figuresOf, measured, type Report } from "./reports";

/** Actions on a job. */
export interface Actions {
  cancel: () => void;
  /** Resolves when the service has taken note. */
  finish: () => Promise<void>;
  /** Runs the job again with the same options and these. */
  again: (more: Record<string, boolean>) => void;
  retry: () => void;
  remove: () => void;
  reuse: () => void;
  position: () => number | null;
  /** The name or the tags of the job are being changed. */
  noted: (saving: Promise<void>) => void;
}

/** Shows a job that waits or runs. */
export class ProgressPanel {
  readonly #energies: number[] = [];
  readonly #bar = element("progress", { max: 1, value: 0, aria: { label: "Share of the work done" } });
  readonly #stage = element("p", { className: "stage", aria: { role: "status" } });
  readonly #stages = new Stages();
  readonly #facts = element("div");
  readonly #finish: HTMLButtonElement;
  readonly #note = element("p", { className: "hint", aria: { role: "status" } });
  #isFinishing = false;
  #latest: Progress;
  readonly #cancel: HTMLButtonElement;
  readonly #curve = element("div", { className: "energies", title: "Energy of the chart at hand, iteration by iteration" });

  constructor(readonly job: Job, readonly actions: Actions) {
    this.#latest = job;
    this.#finish = button("Finish early", () => void this.#finishEarly(), { title: "Take the current map, which is valid, as the result" });
    this.#cancel = button("Cancel", actions.cancel);
    byId("inspector").replaceChildren(
      element("section", { className: "progress-panel" }, this.#stage, this.#bar,
        // The buttons come before the parts that grow, so that they do not move.
        element("div", { className: "actions" }, this.#finish, this.#cancel), this.#note,
        this.#stages.list, this.#facts, this.#curve),
      ...notesOf(job, actions.noted));
    this.show(job);
  }

  /** Asks for the end, and says so until it comes: the step under way is completed first. */
  async #finishEarly(): Promise<void> {
    this.#isFinishing = true;
    this.show(this.#latest);
    await this.actions.finish().catch(() => (this.#isFinishing = false));
    this.show(this.#latest);
  }

  show(event: Progress): void {
    this.#latest = event;
    const position = this.actions.position();
    this.#stage.textContent = event.state === "queued" ? (position ? `Number ${position} in the queue` : "In the queue") : doing(event);
    this.#bar.value = event.fraction;
    this.#stages.show(event);
    this.#finish.textContent = this.#isFinishing ? "Finishing …" : "Finish early";
    this.#finish.disabled = this.#isFinishing || isFinal(event.state);
    this.#cancel.disabled = isFinal(event.state);
    this.#note.textContent = this.#isFinishing && !isFinal(event.state) ? "The current map becomes the result as soon as the step under way is done." : "";
    const isMapping = event.stage === "map" || event.stage === "deform";
    if (isMapping && event.energy !== null) this.#energies.push(event.energy);
    this.#facts.replaceChildren(pairs([
      ["Done", percent(event.fraction)],
      ["Time", duration(event.elapsed_ms)],
      ["Time left", left(event)],
      ["Maps made", event.charts ? `${event.chart} of ${event.charts} so far` : "–", "Pieces that are cut again are mapped again"],
      ["Iteration", isMapping ? whole(event.iteration) : "–"],
      ["Energy", isMapping ? short(event.energy) : "–"],
      ["Smallest face", isMapping ? short(event.smallest) : "–", "As a share of its rest area: positive means that nothing is flipped"],
    ]));
    if (1 < this.#energies.length) this.#curve.replaceChildren(curve(this.#energies.slice(-200), "Energy"));
  }
}

/** Shows a job that has ended. */
export async function showEnded(job: Job, report: Report | null, actions: Actions): Promise<void> {
  const options = await chosenOptions(job.kind, job.options).catch(() => ({}));
  const parts: (Node | null)[] = [verdict(job), gates(job), failure(job), report?.proven ? proofs(report) : null];
  if (report) parts.push(facts(report));
  if (job.warnings.length) parts.push(section("Warnings", element("ul", { className: "warnings" }, ...job.warnings.map((warning) => warned(warning, actions)))));
  if (job.links.files.length) parts.push(section("Files", files(job)));
  parts.push(section("Job", about(job, options), element("div", { className: "actions" },
    job.state === "failed" ? button("Retry", actions.retry) : null,
    button("Use these options", actions.reuse, { title: "Put the options of this job into the form" }),
    button("Delete", actions.remove, { className: "danger" })), copies(job, options)), ...notesOf(job, actions.noted));
  byId("inspector").replaceChildren(...parts.filter((part) => part !== null));
}

function section(title: string, ...content: (Node | null)[]): HTMLElement {
  return element("section", {}, element("h2", { textContent: title }), ...content);
}

function verdict(job: Job): HTMLElement {
  const kind = outcome(job);
  const text = {
    certified: "Certified", open: "Not certified", failed: "Failed", cancelled: "Cancelled", done: job.kind === "measure" ? "Measured" : "Done",
  }[kind];
  const detail = {
    certified: "Everything requested is proven on the bytes of the file.",
    open: "The result exists, but something requested is not proven. The warnings say what.",
    failed: "", cancelled: "Only the record is kept.", done: job.kind === "measure" ? "The UVs of the file as they are." : "",
  }[kind];
  return element("section", { className: `verdict ${kind}` }, element("h2", { textContent: text }), detail ? element("p", { textContent: detail }) : null);
}

/** Warnings with a remedy: the button, and the options with which the job is run again. */
const REMEDIES: Record<string, { label: string; more: Record<string, boolean> }> = {
  uvs_beside_set_0: { label: "Move the textures to the new UVs", more: { rebake: true } },
};

function warned({ code, message }: Job["warnings"][number], actions: Actions): HTMLElement {
  const remedy = REMEDIES[code];
  return element("li", {}, ...prose(sentence(message)), remedy ? button(remedy.label, () => actions.again(remedy.more)) : null);
}

/** Shows the gates of a job and the outcome of judging it. */
function gates({ accept, accepted }: Job): HTMLElement | null {
  if (accept === null || accepted === null) return null;
  return element("section", { className: `verdict ${accepted ? "certified" : "open"}` }, element("h2", { textContent: accepted ? "Accepted" : "Not accepted" }),
    element("p", { textContent: `The job ${accepted ? "meets" : "does not meet"} every gate: ${accept.replaceAll(",", ", ")}.` }));
}

function failure({ error }: Job): HTMLElement | null {
  if (!error) return null;
  return element("section", { className: "failure" }, element("p", {}, element("strong", { textContent: error.title })), element("p", { textContent: error.detail }),
    element("p", { className: "hint" }, "Repair the file or change the options, then try again. ", element("a", { href: `docs#${error.code}`, textContent: `About ${error.code}` })));
}

function proofs(report: Report): HTMLElement {
  const rows = claims(report.proven!).map(({ holds, text, detail }) => element("li", { className: holds ? "holds" : "fails", title: detail },
    element("span", { className: "tick", aria: { hidden: "true" }, textContent: holds ? "✓" : "✕" }), element("span", { textContent: claimed({ holds, text, detail }) })));
  return section("Proven", element("ul", { className: "claims" }, ...rows));
}

function facts(report: Report): HTMLElement | null {
  const groups = measured(report);
  const figures = figuresOf(report);
  if (!figures) return report.groups ? null : section("Report", generic(report));
  return section(groups.length === 1 ? "Result" : `Result: ${groups.length} atlases`, pairs([
    ["Faces", whole(figures.faces)],
    ["Charts", whole(figures.charts)],
    ["Seams / √area", short(figures.seams), "Length of all seams over the square root of the surface area"],
    ["Distortion", short(figures.energy), "Mean symmetric Dirichlet energy; an isometry has 4"],
    ["Covered", percent(figures.fill), "Share of the texture that charts cover"],
    ["Texels per unit", groups.length === 1 ? short(groups[0]!.texels_per_unit) : "by atlas"],
  ]));
}

/** Shows the figures of reports of other kinds. */
export function generic(report: Report): HTMLElement {
  const known = Object.entries(report).filter(([name, value]) => !["schema_version", "unwrapd_version"].includes(name) && ["number", "string", "boolean"].includes(typeof value));
  return pairs(known.map(([name, value]) => [plain(name), typeof value === "number" ? short(value) : typeof value === "boolean" ? (value ? "yes" : "no") : String(value)]));
}

function files(job: Job): HTMLElement {
  return element("ul", { className: "files" }, ...job.links.files.map(({ href, name, bytes: size }, k) => element("li", {},
    element("a", { href: address(href), download: name, className: k ? "" : "primary", textContent: name }), element("small", { textContent: size === undefined ? "" : bytes(size) }))));
}

function about(job: Job, options: Record<string, unknown>): HTMLElement {
  const chosen = Object.entries(options).map(([name, value]) => `${plain(name).toLowerCase()} ${typeof value === "object" ? "…" : value}`).join(", ");
  return pairs([
    ["Kind", plain(job.kind)], ...(job.owner ? [["Owner", job.owner] as [string, string]] : []), ["Options", chosen || "defaults"], ["Input", bytes(job.input_bytes)], ["Time", duration(job.elapsed_ms)],
    ["Made", new Date(job.created_at).toLocaleString()], ["Kept until", job.expires_at ? new Date(job.expires_at).toLocaleDateString() : "–"],
    ...(job.cached ? [["Result", "copied from an equal job"] as [string, string]] : []),
  ]);
}

function copies(job: Job, options: Record<string, unknown>): HTMLElement {
  const line = commandLine(job.kind, job.filename, options);
  return element("div", { className: "actions" }, copier("Copy as curl", curl(job.kind, job.filename, options)), line ? copier("Copy as command", line) : null);
}

function copier(label: string, text: string): HTMLButtonElement {
  const made = button(label, () => void copy(text).then((done) => {
    made.textContent = done ? "Copied" : "Not allowed here";
    setTimeout(() => (made.textContent = label), 1500);
  }), { title: text });
  return made;
}

