// The options behind "More": one field each, with the help of the definitions.

import { type Definition, definitions } from "./definitions";
import { element, prose } from "./dom";
import { plain } from "./format";

/** Values that differ from the defaults. */
export type Values = Record<string, string | number | boolean>;

/** Fields for all options of a kind. */
export class OptionForm {
  values: Values = {};
  #fields = new Map<string, HTMLInputElement | HTMLSelectElement>();

  constructor(readonly holder: HTMLElement, readonly changed: () => void) {}

  /** Shows the options of a kind except those that have a place elsewhere. */
  async show(kind: string, elsewhere: string[]): Promise<void> {
    const all = await definitions(kind);
    const known = new Set(all.map(({ name }) => name));
    this.values = Object.fromEntries(Object.entries(this.values).filter(([name]) => known.has(name)));
    this.#fields.clear();
    this.holder.replaceChildren(...all.filter(({ name }) => !elsewhere.includes(name)).map((one) => this.#row(one)));
    this.refresh();
  }

  set(name: string, value: string | number | boolean | null): void {
    if (value === null || value === "" || value === false) delete this.values[name];
    else this.values[name] = value;
    this.refresh();
    this.changed();
  }

  /** Updates the fields from the values. */
  refresh(): void {
    for (const [name, field] of this.#fields) {
      const value = this.values[name];
      if (field instanceof HTMLInputElement && field.type === "checkbox") field.checked = value === true;
      else if (document.activeElement !== field) field.value = value === undefined ? "" : String(value);
    }
  }

  /** Shows only the options whose name or help contains these words. */
  filter(words: string): void {
    for (const row of this.holder.children) {
      (row as HTMLElement).hidden = !row.textContent!.toLowerCase().includes(words.trim().toLowerCase());
    }
  }

  #row(definition: Definition): HTMLElement {
    const { name, help, control } = definition;
    const field = fieldFor(definition);
    field.id = `option-${name}`;
    field.setAttribute("aria-describedby", `help-${name}`);
    field.addEventListener("input", () => {
      const isSwitch = field instanceof HTMLInputElement && field.type === "checkbox";
      this.set(name, isSwitch ? field.checked : control === "number" && field.value !== "" ? Number(field.value) : field.value);
    });
    this.#fields.set(name, field);
    const label = element("label", { htmlFor: field.id, textContent: plain(name) });
    const text = element("p", { id: `help-${name}`, className: "help" }, ...prose(help.replaceAll("\n", " ").replaceAll("_", " ")));
    return element("div", { className: `option ${control}` }, label, field, text);
  }
}

/** Returns whether a word needs another option that no form can set: `seams` are a list of edges. */
function needsMore(name: string, word: string): boolean {
  return name === "cut" && word === "seams";
}

function fieldFor({ name, control, words, default: usual, minimum, maximum, isWhole }: Definition): HTMLInputElement | HTMLSelectElement {
  if (control === "choice") {
    const unset = element("option", { value: "", textContent: usual === null ? "automatic" : `${usual}` });
    const others = words.filter(({ word }) => word !== String(usual) && !needsMore(name, word));
    return element("select", {}, unset, ...others.map(({ word, help }) => element("option", { value: word, textContent: word, title: help })));
  }
  if (control === "switch") return element("input", { type: "checkbox" });
  if (control === "text") return element("input", { type: "text", placeholder: usual === null ? "automatic" : String(usual) });
  return element("input", {
    type: "number", placeholder: usual === null ? "automatic" : String(usual), min: minimum === undefined ? "" : String(minimum),
    max: maximum === undefined ? "" : String(maximum), step: isWhole ? "1" : "any",
  });
}
