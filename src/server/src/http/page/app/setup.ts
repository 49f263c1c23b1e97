// The form: files, three choices, one button; the rest behind "More".

import { createJob, type Job } from "./api";
import { type FormKind, KINDS } from "./definitions";
import { button, byId, element } from "./dom";
import { bytes, counted } from "./format";
import { extension, SHOWN } from "../viewer/loading";
import { OptionForm } from "./option_form";

/** A chosen mesh with the files that it may reference. */
export interface Chosen {
  name: string;
  content: Blob;
  resources: Map<string, Blob>;
  /** Direction from which it is seen first. */
  from?: readonly [number, number, number];
}

/** Callbacks to the page. */
export interface Told {
  /** A file is to be shown. */
  shown(chosen: Chosen): void;
  made(jobs: Job[]): void;
  failed(error: unknown): void;
}

/** Options that have a place of their own in the form. */
const ELSEWHERE = ["resolution"];
/** Names of files that are inputs themselves; others belong to one of them. */
const MESHES = [...SHOWN, "msh", "mesh", "vtk"];

/** The form on the left. */
export class Setup {
  kind: FormKind = "unwrap";
  #chosen: Chosen[] = [];
  readonly #options: OptionForm;

  /** The file that is shown. */
  looked: Chosen | null = null;

  constructor(readonly told: Told) {
    this.#options = new OptionForm(byId("options"), () => this.#refresh());
    this.#wire();
    this.#showKind("unwrap");
  }

  /** Returns the chosen files, or the sample if none is chosen. */
  get chosen(): Chosen[] {
    return this.#chosen;
  }

  choose(chosen: Chosen[]): void {
    this.#chosen = chosen;
    this.#refresh();
    if (chosen[0]) this.look(chosen[0]);
  }

  /** Shows one of the chosen files. */
  look(chosen: Chosen): void {
    this.looked = chosen;
    this.told.shown(chosen);
  }

  /** Copies the options of a job to the form. */
  async take(kind: string, options: Record<string, unknown>): Promise<void> {
    await this.#showKind(kind in KINDS ? (kind as FormKind) : "unwrap");
    this.#options.values = Object.fromEntries(Object.entries(options).filter((entry): entry is [string, string] => typeof entry[1] !== "object"));
    this.#options.refresh();
    this.#refresh();
  }

  /** Opens the dialog that chooses files. */
  ask(): void {
    byId<HTMLInputElement>("files").click();
  }

  /** Takes the files of a drop or of a dialog. */
  takeFiles(files: File[]): void {
    const meshes = files.filter((file) => MESHES.includes(extension(file.name)));
    const resources = new Map(files.filter((file) => !meshes.includes(file)).map((file) => [file.webkitRelativePath || file.name, file as Blob]));
    if (!meshes.length) {
      this.told.failed(new Error(`None of these ${files.length} files is a mesh. Choose GLB, glTF, OBJ, PLY, STL or OFF.`));
      return;
    }
    this.choose(meshes.map((file) => ({ name: file.name, content: file, resources })));
  }

  #wire(): void {
    const form = byId<HTMLFormElement>("setup");
    const files = byId<HTMLInputElement>("files");
    files.addEventListener("change", () => {
      if (files.files?.length) this.takeFiles([...files.files]);
      files.value = "";
    });
    byId("choose").addEventListener("click", () => this.ask());
    // Show an invalid field, since the browser cannot point at a hidden one.
    form.addEventListener("invalid", ({ target }) => {
      byId<HTMLDetailsElement>("more").open = true;
      byId<HTMLInputElement>("find-option").value = "";
      this.#options.filter("");
      (target as HTMLElement).scrollIntoView({ block: "nearest" });
    }, { capture: true });
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void this.submit();
    });
    for (const radio of form.querySelectorAll<HTMLInputElement>("input[name=purpose]")) {
      radio.addEventListener("change", () => {
        this.#options.set("preset", radio.value === "lightmap" ? "lightmap" : null);
        this.#options.set("quality", radio.value === "few" ? "few" : null);
      });
    }
    byId("resolution").addEventListener("change", () => this.#options.set("resolution", resolutionOf(byId<HTMLSelectElement>("resolution").value)));
    byId("keep").addEventListener("change", () => this.#options.set("cut", byId<HTMLInputElement>("keep").checked ? "keep" : null));
    byId("kind").addEventListener("change", () => void this.#showKind(byId<HTMLSelectElement>("kind").value as FormKind));
    byId("find-option").addEventListener("input", () => this.#options.filter(byId<HTMLInputElement>("find-option").value));
    byId("reset").addEventListener("click", () => {
      this.#options.values = {};
      this.#options.refresh();
      this.#refresh();
    });
  }

  async #showKind(kind: FormKind): Promise<void> {
    this.kind = kind;
    await this.#options.show(kind, ELSEWHERE).catch((error: unknown) => this.told.failed(error));
    this.#refresh();
  }

  #refresh(): void {
    const { values } = this.#options;
    const isUnwrap = this.kind === "unwrap";
    byId<HTMLSelectElement>("kind").value = this.kind;
    byId<HTMLFieldSetElement>("purpose").disabled = !isUnwrap;
    byId<HTMLInputElement>("keep").disabled = !isUnwrap;
    const purpose = values.preset === "lightmap" ? "lightmap" : values.quality === "few" ? "few" : "material";
    byId<HTMLInputElement>(`purpose-${purpose}`).checked = true;
    byId<HTMLInputElement>("keep").checked = values.cut === "keep";
    this.#refreshResolution(String(values.resolution ?? "1024"));
    const count = Object.keys(values).length;
    byId("changed").textContent = count ? `${counted(count, "option")} set` : "";
    byId("reset").hidden = count === 0;
    const verb = { unwrap: "Unwrap", repack: "Repack", measure: "Measure", verify: "Verify" }[this.kind];
    byId("submit").textContent = 1 < this.#chosen.length ? `${verb} ${counted(this.#chosen.length, "file")}` : verb;
    byId("chosen").replaceChildren(...this.#chosen.map((one) => this.#chip(one)));
  }

  #refreshResolution(value: string): void {
    const select = byId<HTMLSelectElement>("resolution");
    if (![...select.options].some((option) => option.value === value)) select.append(element("option", { value, textContent: value }));
    select.value = value;
  }

  #chip(one: Chosen): HTMLElement {
    const remove = button("×", () => {
      this.#chosen = this.#chosen.filter((other) => other !== one);
      this.#refresh();
      if (this.looked === one && this.#chosen[0]) this.look(this.#chosen[0]);
    }, { className: "bare", aria: { label: `Remove ${one.name}` } });
    const others = one.resources.size ? ` + ${one.resources.size}` : "";
    return element("li", { title: one.name }, button(one.name, () => this.look(one), { className: "name", title: `Look at ${one.name}` }), element("small", { textContent: `${bytes(one.content.size)}${others}` }), remove);
  }

  /** Submits each chosen file as a job if all options are within their ranges. */
  async submit(): Promise<void> {
    if (!byId<HTMLFormElement>("setup").reportValidity()) return;
    if (!this.#chosen.length) return this.ask();
    const submit = byId<HTMLButtonElement>("submit");
    submit.disabled = true;
    const jobs: Job[] = [];
    try {
      for (const one of this.#chosen) jobs.push(await createJob(this.kind, this.#options.values, one));
    } catch (error) {
      this.told.failed(error);
    } finally {
      submit.disabled = false;
      if (jobs.length) this.told.made(jobs);
    }
  }
}

/** Parses a side, or width and height; null stands for the default. */
function resolutionOf(text: string): string | number | null {
  return text === "1024" ? null : /^\d+$/.test(text) ? Number(text) : text;
}
