// The tools above the views.

import { SHADES, type Shade } from "../viewer/look";
import { type Aim, type Place } from "./address";
import { button, byId, element } from "./dom";
import { counted } from "./format";
import type { Viewer } from "./viewer";

const SHADE_NAMES: Record<Shade, string> = { plain: "Plain", charts: "Charts", checker: "Checker", heat: "Heat map", image: "Image", material: "Material", padding: "Padding" };
export const MEASURE_NAMES = { "sym-dirichlet": "Symmetric Dirichlet", angle: "Angle", area: "Area", density: "Texel density" } as const;
const AIMS: Record<Aim, string> = { face: "Face", chart: "Chart", seam: "Seam" };
const SWITCHES = { seams: "Seams", wire: "Wire", problems: "Problems", only: "Isolate" } as const;
type Switch = keyof typeof SWITCHES;
const ALONE = [["solid", "3D", "The surface alone (M)"], ["plane", "UV", "The UVs alone (M)"]] as const;

/** The tools; each changes the state. */
export class Toolbar {
  readonly #viewer: Viewer;
  readonly #changed: (changes: Partial<Place>) => void;
  readonly #before: HTMLButtonElement;
  readonly #both: HTMLButtonElement;
  /** The fills as a list, which takes less room than buttons. */
  readonly #fill = element("select", { id: "fill", title: "Fill (C)", aria: { label: "Fill" } }, ...SHADES.map((shade) => element("option", { value: shade, textContent: SHADE_NAMES[shade] })));
  readonly #atlas = element("select", { id: "atlas", aria: { label: "Atlas" } });
  readonly #set = element("select", { id: "set", title: "UV set of the file (T)", aria: { label: "UV set" } });
  readonly #image = element("input", { type: "file", accept: "image/*", hidden: true, aria: { label: "Image for the faces" } });

  constructor(viewer: Viewer, changed: (changes: Partial<Place>) => void, compare: (uvs: "before" | "both") => void) {
    this.#viewer = viewer;
    this.#changed = changed;
    this.#fill.addEventListener("change", () => this.#chooseFill(this.#fill.value as Shade));
    this.#atlas.addEventListener("change", () => changed({ atlas: this.#atlas.value, face: null, chart: null, seam: null, plane: null }));
    this.#set.addEventListener("change", () => changed(otherSet(viewer, Number(this.#set.value))));
    this.#image.addEventListener("change", () => void this.#useImage());
    this.#before = button("Before", () => compare("before"), { className: "comparing", title: "The UVs that the input had (B)", aria: { pressed: "false" } });
    this.#both = button("Side by side", () => compare("both"), { title: "The UVs of the result above those of the input, with one camera and one scale (D)", className: "comparing", aria: { pressed: "false" } });
    byId("toolbar").append(
      this.#fill, group("Fill", ...SHADES.map((shade) => this.#choice("shade", shade, SHADE_NAMES[shade]))),
      group("Alone", ...ALONE.map(([alone, text, title]) => button(text, () => changed({ alone: viewer.place.alone === alone ? null : alone }), { title, data: { alone }, aria: { pressed: "false" } }))),
      button("Frame", () => viewer.frameSelection(), { title: "Show the selection, or everything (F)" }), this.#before, this.#both, this.#set, this.#atlas, this.#image,
    );
    byId("pointed").after(group("Point at", ...(Object.keys(AIMS) as Aim[]).map((aim) => this.#choice("aim", aim, AIMS[aim]))));
    byId("faults").after(group("Show", ...(Object.keys(SWITCHES) as Switch[]).map((name) => this.#toggle(name))));
  }

  #choice(name: "shade" | "aim", value: string, text: string): HTMLElement {
    return button(text, () => (name === "shade" ? this.#chooseFill(value as Shade) : this.#changed({ aim: value as Aim })), { data: { [name]: value }, aria: { pressed: "false" } });
  }

  #chooseFill(shade: Shade): void {
    this.#fill.value = this.#viewer.place.shade;
    if (shade === "image") this.#image.click();
    else this.#changed({ shade });
  }

  #toggle(name: Switch): HTMLElement {
    return button(SWITCHES[name], () => this.#changed({ [name]: !this.#viewer.place[name] }), { data: { switch: name }, aria: { pressed: "false" } });
  }

  async #useImage(): Promise<void> {
    const file = this.#image.files?.[0];
    this.#image.value = "";
    if (!file) return;
    await this.#viewer.useImage(file);
    this.#changed({ shade: "image" });
  }

  /** Updates the tools from the state. */
  refresh(hasBefore: boolean): void {
    const { place, analysis } = this.#viewer;
    for (const tool of byId("view").querySelectorAll<HTMLElement>(".tools button")) {
      const { shade, aim, alone, switch: name } = tool.dataset;
      tool.setAttribute("aria-pressed", String(shade === place.shade || aim === place.aim || alone === (place.alone ?? "") || (name !== undefined && place[name as Switch])));
    }
    this.#fill.value = place.shade;
    this.#before.setAttribute("aria-pressed", String(place.uvs === "before"));
    this.#both.setAttribute("aria-pressed", String(place.uvs === "both"));
    this.#before.disabled = this.#both.disabled = !hasBefore;
    const atlases = analysis?.atlases ?? [];
    this.#atlas.replaceChildren(...atlases.map(({ name, label, charts, isMapped }) => element("option", { value: name, textContent: `${label} · ${isMapped ? counted(charts, "chart") : "no UVs"}` })));
    this.#atlas.value = atlases[this.#viewer.atlas]?.name ?? "";
    this.#atlas.hidden = atlases.length < 2;
    this.#showSets();
    byId("toolbar").classList.toggle("crowded", !this.#atlas.hidden || !this.#set.hidden);
  }

  #showSets(): void {
    const { sets = [], set = 0, first, source } = this.#viewer.facts ?? {};
    const said = (number: number) => (number === first && source?.texcoord ? " · new" : "");
    this.#set.replaceChildren(...sets.map((number) => element("option", { value: String(number), textContent: `UV set ${number}${said(number)}` })));
    this.#set.value = String(set);
    this.#set.hidden = sets.length < 2;
  }
}

/** Returns the changes that show another UV set of a file, without a selection. */
export function otherSet({ facts }: Viewer, set: number): Partial<Place> {
  return { set: set === facts?.first ? null : set, atlas: null, face: null, chart: null, seam: null, plane: null };
}

function group(label: string, ...tools: HTMLElement[]): HTMLElement {
  return element("div", { className: "tools", aria: { role: "group", label } }, ...tools);
}
