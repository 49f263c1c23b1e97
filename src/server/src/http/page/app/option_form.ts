// The options behind "More": one field each, in groups, with the help of the definitions.

import { type Definition, definitions } from "./definitions";
import { element, prose } from "./dom";
import { plain } from "./format";
import { GROUP_NAMES, groupOf, REST } from "./option_groups";

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
  /** The words that are sought. */
  #sought = "";
  readonly #none = element("p", { className: "help", hidden: true, aria: { role: "status" }, textContent: "No option has these words." });
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
    const rows = all.filter(({ name }) => !elsewhere.includes(name)).map((one) => ({ ...groupOf(one.name), row: this.#row(one) }));
    const groups = GROUP_NAMES.map((name) => ({ name, own: rows.filter(({ group }) => group === name).map(({ row }) => row) }));
    this.holder.replaceChildren(...groups.filter(({ own }) => own.length).map(({ name, own }, k) =>
      element("details", { className: "group", open: k === 0, data: { group: name } }, element("summary", { textContent: name }), ...own)), this.#none);
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
    this.filter(this.#sought);
  }

  /** Shows only the options whose names or help contain these words. Without words, options of the last group are shown if
   * they are set. */
  filter(words: string): void {
    const sought = words.trim().toLowerCase();
    const isNew = sought !== this.#sought;
    this.#sought = sought;
    let found = 0;
    for (const group of this.holder.querySelectorAll<HTMLDetailsElement>(".group")) {
      const rows = [...group.querySelectorAll<HTMLElement>(".option")];
      const isRest = group.dataset.group === REST;
      for (const row of rows) {
        const name = row.dataset.option!;
        const isSought = `${name} ${row.textContent}`.toLowerCase().includes(sought);
        row.hidden = sought ? !isSought : isRest && !(name in this.#values);
      }
      const count = rows.filter(({ hidden }) => !hidden).length;
      found += count;
      group.hidden = count === 0;
      if (isNew && sought) group.open = true;
    }
    this.#none.hidden = 0 < found || !sought;
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
    const { words } = groupOf(name);
    const label = element("label", { htmlFor: field.id, title: `${name} in the API` }, words?.label ?? plain(name), words?.unit ? element("small", { textContent: ` ${words.unit}` }) : null);
    const text = element("p", { id: `help-${name}`, className: "help" }, ...prose(help.replaceAll("\n", " ").replaceAll("_", " ")));
    return element("div", { className: `option ${control}`, data: { option: name } }, label, field, text);
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
