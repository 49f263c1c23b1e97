// The options behind "More": one field each, with the help of the definitions.

import { type Definition, definitions } from "./definitions";
import { element, prose } from "./dom";
import { plain } from "./format";

/** Values that differ from the defaults. */
export type Values = Record<string, string | number | boolean>;

/** Returns values with another value of an option; the default is not among them. */
export function withOption(values: Values, name: string, value: Values[string] | null): Values {
  const { [name]: _, ...others } = values;
  return value === null || value === "" || value === false ? others : { ...others, [name]: value };
}

/** Fields for all options of a kind. */
export class OptionForm {
  #kind = "";
  #values: Values = {};
  #fields = new Map<string, HTMLInputElement | HTMLSelectElement>();

  constructor(readonly holder: HTMLElement, readonly changed: (values: Values) => void) {}

  /** Shows the options of a kind with their values, except those that have a place elsewhere. Drops values of options that
   * the kind does not have. */
  async show(kind: string, values: Values, elsewhere: string[]): Promise<void> {
    this.#values = values;
    if (kind === this.#kind) return this.#refresh();
    this.#kind = kind;
    const all = await definitions(kind).catch((error: unknown) => {
      this.#kind = "";
      throw error;
    });
    if (kind !== this.#kind) return;
    this.#fields.clear();
    this.holder.replaceChildren(...all.filter(({ name }) => !elsewhere.includes(name)).map((one) => this.#row(one)));
    this.#refresh();
    const known = new Set(all.map(({ name }) => name));
    const own = Object.entries(this.#values).filter(([name]) => known.has(name));
    if (own.length < Object.keys(this.#values).length) this.changed(Object.fromEntries(own));
  }

  /** Updates the fields from the values. */
  #refresh(): void {
    for (const [name, field] of this.#fields) {
      const value = this.#values[name];
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
      this.changed(withOption(this.#values, name, isSwitch ? field.checked : control === "number" && field.value !== "" ? Number(field.value) : field.value));
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
