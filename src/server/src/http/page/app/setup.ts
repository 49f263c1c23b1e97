// The form: files, three choices, one button; the rest behind "More".

import { createJob, createJobFrom, type Job, Refused, type Upload } from "./api";
import { chosenOptions, type FormKind, KINDS } from "./definitions";
import { button, byId, element } from "./dom";
import { unpacked } from "./dropped";
import { chosenIn, type Given, nameOfAll, resourcesOf } from "./given";
import { bytes, counted } from "./format";
import { extension, SHOWN } from "../viewer/formats";
import { acceptOf, Gates } from "./gates";
import { Presets } from "./presets";
import { OptionForm, type Values, withOption } from "./option_form";
import type { Chosen, State, Store } from "./store";

/** Callbacks to the page. */
export interface Told {
  /** A file is to be shown. */
  shown(chosen: Chosen): void;
  /** A job was made of an input; `isFurther` if it is another one of several files. */
  made(job: Job, input: Chosen | null, isFurther?: boolean): void;
  /** A file was chosen that can only be pulled. */
  pulled(file: Given): void;
  failed(error: unknown): void;
}

/** Kinds of jobs whose input is a surface, which can be unwrapped. */
const SURFACES = ["unwrap", "repack", "measure", "verify", "edit_uv", "texture_map"];
/** Entry of the list of resolutions that stands for all others. */
const OTHER = "other";
/** Options that have a place of their own in the form. */
const ELSEWHERE = ["resolution"];
/** Names of files that are inputs themselves; others belong to one of them. */
const MESHES = [...SHOWN, "zip"];
/** Names of files that cannot be unwrapped but pulled: bodies, pictures and outlines. */
const PULLED = ["msh", "mesh", "tet", "png", "jpg", "jpeg", "webp", "svg"];

/** Inputs that the next jobs are made of: those on screen. */
type Target = { files: Chosen[] } | { job: Job; input: Chosen | null } | { none: string };

/** Returns the inputs that the next jobs are made of. */
function targetOf({ subject, chosen }: State): Target {
  if (subject.kind !== "job") return { files: chosen };
  const { job, input } = subject;
  if (!SURFACES.includes(job.kind)) return { none: "The job on screen has no surface to unwrap." };
  if (job.state !== "cancelled") return { job, input };
  // The service removes the files of a cancelled job.
  return input ? { files: [input] } : { none: "The files of a cancelled job are removed. Choose the mesh again." };
}

/** The form on the left. */
export class Setup {
  readonly #options: OptionForm;
  readonly #presets: Presets;
  readonly #gates: Gates;

  constructor(readonly store: Store, readonly told: Told) {
    this.#options = new OptionForm(byId("options"), (options) => store.change({ options }));
    this.#presets = new Presets(store);
    this.#gates = new Gates(store);
    this.#wire();
    store.show(() => this.#refresh());
  }

  choose(chosen: Chosen[], source: string | null = null): void {
    this.store.change({ chosen, source });
    if (chosen[0]) this.told.shown(chosen[0]);
  }

  /** Copies the options of a job to the form. */
  async take(kind: string, options: Record<string, unknown>): Promise<void> {
    const taken = Object.entries(options).filter((entry): entry is [string, Values[string]] => entry[1] !== null && typeof entry[1] !== "object");
    this.store.change({ kind: kind in KINDS ? (kind as FormKind) : "unwrap", options: (await chosenOptions(kind, Object.fromEntries(taken))) as Values });
  }

  #set(name: string, value: Values[string] | null): void {
    this.store.change({ options: withOption(this.store.state.options, name, value) });
  }

  /** Opens the dialog that chooses files. */
  ask(): void {
    byId<HTMLInputElement>("files").click();
  }

  /** Takes the files of a drop or of a dialog. */
  async takeFiles(given: Given[]): Promise<void> {
    const files = await unpacked(given);
    const meshes = files.filter(({ path }) => MESHES.includes(extension(path))).sort((one, other) => one.path.localeCompare(other.path));
    const others = files.filter((file) => !meshes.includes(file));
    const pulled = others.find(({ path }) => PULLED.includes(extension(path)));
    if (!meshes.length && pulled) return this.told.pulled(pulled);
    if (!meshes.length) {
      this.told.failed(new Error(`${files.length === 1 ? "This file is no mesh" : `These ${files.length} files include no mesh`}. Choose GLB, glTF, OBJ, PLY, STL or OFF, a folder of them, or a ZIP.`));
      return;
    }
    const source = nameOfAll(given);
    this.choose(meshes.map((mesh) => {
      const path = source !== null && mesh.path.startsWith(`${source}/`) ? mesh.path.slice(source.length + 1) : mesh.path;
      const name = path.split("/").pop()!;
      return { name, content: mesh.content, resources: resourcesOf(mesh, meshes, others), ...(path !== name && { path }) };
    }), source);
  }

  #wire(): void {
    const form = byId<HTMLFormElement>("setup");
    for (const id of ["files", "folder"]) {
      const input = byId<HTMLInputElement>(id);
      input.addEventListener("change", () => {
        if (input.files?.length) void this.takeFiles(chosenIn(input));
      });
    }
    byId("choose").addEventListener("click", () => this.ask());
    byId("choose-folder").addEventListener("click", () => byId<HTMLInputElement>("folder").click());
    // Show an invalid field, since the browser cannot point at a hidden one.
    form.addEventListener("invalid", ({ target }) => {
      byId<HTMLDetailsElement>("more").open = true;
      byId<HTMLInputElement>("find-option").value = "";
      this.#options.filter("");
      const group = (target as HTMLElement).closest("details.group") as HTMLDetailsElement | null;
      if (group) group.open = true;
      (target as HTMLElement).scrollIntoView({ block: "nearest" });
    }, { capture: true });
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.submit();
    });
    for (const radio of form.querySelectorAll<HTMLInputElement>("input[name=purpose]")) {
      radio.addEventListener("change", () => {
        this.#set("preset", radio.value === "lightmap" ? "lightmap" : null);
        this.#set("quality", radio.value === "few" ? "few" : null);
      });
    }
    byId("resolution").addEventListener("change", () => this.#chooseResolution(byId<HTMLSelectElement>("resolution").value));
    const size = byId<HTMLInputElement>("size");
    const takeSize = () => {
      const text = size.value.replaceAll(" ", "").replace("×", "x");
      size.setCustomValidity(isSize(text) ? "" : "The sides must differ by a power of two up to 16: 3000 × 1500.");
      if (text && size.reportValidity()) this.#set("resolution", resolutionOf(text));
    };
    size.addEventListener("change", takeSize);
    size.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      // The form would be submitted.
      event.preventDefault();
      takeSize();
    });
    byId("keep").addEventListener("change", () => this.#set("cut", byId<HTMLInputElement>("keep").checked ? "keep" : null));
    byId("kind").addEventListener("change", () => this.store.change({ kind: byId<HTMLSelectElement>("kind").value as FormKind }));
    byId("find-option").addEventListener("input", () => this.#options.filter(byId<HTMLInputElement>("find-option").value));
    byId("reset").addEventListener("click", () => this.store.change({ options: {} }));
    // The options are described by the service, which is asked only if someone wants to see them.
    byId("more").addEventListener("toggle", () => this.#refresh());
  }

  #refresh(): void {
    const { kind, options, chosen, subject } = this.store.state;
    const isUnwrap = kind === "unwrap";
    if (byId<HTMLDetailsElement>("more").open) void this.#options.show(kind, options, ELSEWHERE).catch((error: unknown) => this.told.failed(error));
    byId<HTMLSelectElement>("kind").value = kind;
    byId<HTMLFieldSetElement>("purpose").disabled = !isUnwrap;
    byId<HTMLInputElement>("keep").disabled = !isUnwrap;
    const purpose = options.preset === "lightmap" ? "lightmap" : options.quality === "few" ? "few" : "material";
    byId<HTMLInputElement>(`purpose-${purpose}`).checked = true;
    byId<HTMLInputElement>("keep").checked = options.cut === "keep";
    this.#refreshResolution(String(options.resolution ?? "1024"));
    const count = Object.keys(options).length;
    byId("changed").textContent = count ? `${counted(count, "option")} set` : "";
    byId("reset").hidden = count === 0;
    this.#presets.refresh();
    this.#gates.refresh();
    this.#refreshTarget();
    const looked = subject.kind === "file" ? subject.file : null;
    byId("chosen").replaceChildren(...chosen.map((one) => this.#chip(one, one === looked)));
  }

  /** Names what the button acts on. */
  #refreshTarget(): void {
    const { kind } = this.store.state;
    const target = targetOf(this.store.state);
    const verb = { unwrap: "Unwrap", repack: "Repack", measure: "Measure", verify: "Verify" }[kind];
    const files = "files" in target ? target.files : [];
    byId("submit").textContent = 1 < files.length ? `${verb} ${counted(files.length, "file")}` : "job" in target && target.job.kind === kind ? `${verb} again` : verb;
    byId<HTMLButtonElement>("submit").disabled = this.#isSending || "none" in target;
    byId("target").textContent = "none" in target ? target.none : "job" in target ? `The input of this job: ${target.job.filename}` : "";
  }

  /** Takes a resolution of the list, or shows the field for another one. */
  #chooseResolution(value: string): void {
    const size = byId<HTMLInputElement>("size");
    size.parentElement!.hidden = value !== OTHER;
    if (value !== OTHER) return this.#set("resolution", resolutionOf(value));
    size.value = String(this.store.state.options.resolution ?? 1024).replace("x", " × ");
    size.select();
  }

  #refreshResolution(value: string): void {
    const select = byId<HTMLSelectElement>("resolution");
    const isListed = [...select.options].some((option) => option.value === value);
    const size = byId<HTMLInputElement>("size");
    if (isListed && select.value === OTHER) return;
    if (!isListed) size.value = value.replace("x", " × ");
    select.value = isListed ? value : OTHER;
    size.parentElement!.hidden = isListed;
  }

  #chip(one: Chosen, isLooked: boolean): HTMLElement {
    const remove = button("×", () => {
      const chosen = this.store.state.chosen.filter((other) => other !== one);
      this.store.change({ chosen });
      if (isLooked && chosen[0]) this.told.shown(chosen[0]);
    }, { className: "bare", aria: { label: `Remove ${one.name}` } });
    const others = one.resources.size ? ` + ${one.resources.size}` : "";
    const look = button(one.name, () => this.told.shown(one), { className: "name", title: `Look at ${one.name}`, aria: isLooked ? { current: "true" } : {} });
    return element("li", { title: one.name }, look, element("small", { textContent: `${bytes(one.content.size)}${others}` }), remove);
  }

  #isSending = false;

  /** Makes a job of each input on screen if all options are within their ranges; `more` are options of this time. */
  async submit(more: Values = {}): Promise<void> {
    if (this.#isSending || !byId<HTMLFormElement>("setup").reportValidity()) return;
    const { kind, options, gates } = this.store.state;
    const accept = acceptOf(gates);
    const target = targetOf(this.store.state);
    if ("none" in target) return this.told.failed(new Error(target.none));
    if ("files" in target && !target.files.length) return this.ask();
    const values = { ...options, ...more };
    this.#send(true);
    try {
      if ("job" in target) this.told.made(await createJobFrom(target.job, kind, values, accept), target.input);
      else await this.#upload(target.files, (input, metadata, sending) => createJob(kind, values, input, { accept, metadata, sending }));
    } catch (error) {
      if (!(error instanceof DOMException && error.name === "AbortError")) this.told.failed(error);
    } finally {
      this.#send(false);
    }
  }

  /** Uploads files one after the other, and shows how far it is. Jobs of several files have a batch in common. If the
   * service refuses a file, the others are still sent; throws at the end if it refused all. */
  async #upload(files: Chosen[], each: (file: Chosen, metadata: Record<string, unknown>, sending: Upload) => Promise<Job>): Promise<void> {
    const abort = new AbortController();
    const [bar, said] = [byId<HTMLProgressElement>("sent"), byId("sent-text")];
    byId("cancel-sending").onclick = () => abort.abort();
    // Swedish writes times as ISO 8601 does, with a space.
    const time = new Date().toLocaleString("sv");
    const { source } = this.store.state;
    const batch = source === null ? time : `${source} ${time}`;
    const metadata = 1 < files.length ? { batch } : {};
    const refused: string[] = [];
    let made = 0;
    for (const [k, file] of files.entries()) {
      const ordinal = 1 < files.length ? `${k + 1} of ${files.length}: ` : "";
      const progressed = (sent: number, total: number) => {
        bar.value = total ? sent / total : 0;
        said.textContent = `${ordinal}${bytes(sent)} of ${bytes(total)} sent`;
      };
      progressed(0, file.content.size);
      try {
        const job = await each(file, { ...metadata, ...(file.path && { path: file.path }) }, { progressed, signal: abort.signal });
        this.told.made(job, file, 0 < made++);
      } catch (error) {
        if (files.length === 1 || !(error instanceof Refused)) throw error;
        refused.push(`${file.path ?? file.name}: ${error.message}`);
      }
    }
    if (refused.length && !made) throw new Error(`All files are refused. ${refused.join(" ")}`);
    if (refused.length) this.store.change({ refused: { batch, files: refused } });
  }

  #send(isSending: boolean): void {
    this.#isSending = isSending;
    byId("sending").hidden = !isSending || "job" in targetOf(this.store.state);
    this.#refreshTarget();
  }
}

/** Returns whether the sides of a resolution differ as the service allows. */
function isSize(text: string): boolean {
  const [width = 1, height = width] = text.split("x").map(Number);
  return [1, 2, 4, 8, 16].includes(Math.max(width, height) / Math.min(width, height));
}

/** Parses a side, or width and height; null stands for the default. */
function resolutionOf(text: string): string | number | null {
  return text === "1024" ? null : /^\d+$/.test(text) ? Number(text) : text;
}
