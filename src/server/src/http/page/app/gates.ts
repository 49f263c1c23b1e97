// The gates of the next jobs: what a result has to meet to be accepted.

import { byId, element } from "./dom";
import { type Values, withOption } from "./option_form";
import type { Store } from "./store";

/** A limit of a gate in the words of the trade; the unit follows the field. */
interface Gate { name: string; label: string; help: string; unit?: string; least?: number; step?: string }

const GATES: Gate[] = [
  { name: "certified", label: "Certified", help: "Everything that was requested is proven" },
  { name: "max_charts", label: "Charts at most", help: "Number of charts of all atlases", least: 1, step: "1" },
  { name: "max_distortion", label: "Distortion at most", help: "Mean symmetric Dirichlet energy of the worst atlas; an isometry has 4", least: 4, step: "any" },
  { name: "max_stretch", label: "Stretch at most", help: "99th percentile of the stretch; 1 is none", least: 1, step: "any" },
  { name: "max_seconds", label: "Time at most", help: "Time of the computation", unit: "s", least: 0, step: "any" },
];

/** Returns gates as the service reads them; nothing without any. */
export function acceptOf(gates: Values): string {
  return GATES.filter(({ name }) => gates[name]).map(({ name }) => (gates[name] === true ? name : `${name}=${gates[name]}`)).join(",");
}

/** The fields of the gates. */
export class Gates {
  readonly #fields = new Map<string, HTMLInputElement>();

  constructor(readonly store: Store) {
    byId("gates").append(...GATES.map((gate) => this.#row(gate)));
  }

  #row({ name, label, help, unit, least, step }: Gate): HTMLElement {
    const field = element("input", { id: `gate-${name}`, type: step ? "number" : "checkbox", title: help, ...(step && { min: String(least), step }) });
    this.#fields.set(name, field);
    field.addEventListener("change", () => {
      const value = field.type === "checkbox" ? field.checked : field.value && field.valueAsNumber;
      this.store.change({ gates: withOption(this.store.state.gates, name, value) });
    });
    return element("div", { className: "row" }, element("label", { htmlFor: field.id, textContent: unit ? `${label} (${unit})` : label }), field);
  }

  /** Shows the gates of the state. */
  refresh(): void {
    const { gates } = this.store.state;
    for (const [name, field] of this.#fields) {
      if (field.type === "checkbox") field.checked = gates[name] === true;
      else if (document.activeElement !== field) field.value = String(gates[name] ?? "");
    }
    const count = Object.keys(gates).length;
    byId("gated").textContent = count ? String(count) : "";
  }
}
