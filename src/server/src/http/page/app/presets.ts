// Options that a person has saved under names, in this browser.

import { byId, element } from "./dom";
import type { Preset } from "./memory";
import type { State, Store } from "./store";

/** Returns the preset that the form agrees with. */
function presetOf({ presets, kind, options }: State): Preset | null {
  const text = (values: object) => JSON.stringify(Object.entries(values).sort());
  return presets.find((one) => one.kind === kind && text(one.options) === text(options)) ?? null;
}

/** The fields that save, apply and delete presets. */
export class Presets {
  readonly #list = byId<HTMLSelectElement>("saved");
  readonly #name = byId<HTMLInputElement>("preset-name");
  readonly #save = byId<HTMLButtonElement>("save-preset");
  readonly #delete = byId<HTMLButtonElement>("delete-preset");

  constructor(readonly store: Store) {
    this.#list.addEventListener("change", () => {
      const chosen = store.state.presets.find(({ name }) => name === this.#list.value);
      store.change(chosen ? { kind: chosen.kind, options: chosen.options } : { kind: "unwrap", options: {} });
    });
    this.#save.addEventListener("click", () => this.#keep());
    this.#delete.addEventListener("click", () => store.change({ presets: store.state.presets.filter((one) => one !== presetOf(store.state)) }));
    this.#name.addEventListener("input", () => this.refresh());
    this.#name.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      // The form would be submitted.
      event.preventDefault();
      this.#keep();
    });
  }

  /** Saves the options of the form under the typed name, in place of what has the name. */
  #keep(): void {
    const name = this.#name.value.trim();
    if (!name) return;
    const { presets, kind, options } = this.store.state;
    this.#name.value = "";
    this.store.change({ presets: [...presets.filter((one) => one.name !== name), { name, kind, options }].sort((one, other) => one.name.localeCompare(other.name)) });
  }

  /** Shows the presets, and which of them the form agrees with. */
  refresh(): void {
    const { presets } = this.store.state;
    const now = presetOf(this.store.state);
    this.#list.replaceChildren(element("option", { value: "", textContent: now ? "Defaults" : "–" }), ...presets.map(({ name }) => element("option", { value: name, textContent: name })));
    this.#list.value = now?.name ?? "";
    this.#list.closest<HTMLElement>(".row")!.hidden = presets.length === 0;
    this.#save.disabled = !this.#name.value.trim();
    this.#delete.hidden = now === null;
    if (now) this.#delete.title = `Delete the preset ${now.name}`;
  }
}
