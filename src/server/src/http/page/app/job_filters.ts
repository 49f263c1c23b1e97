// Filters of the job list.

import { byId } from "./dom";

const HOUR_MS = 3_600_000;

/** Parses a member of metadata like the service: as JSON if it is valid JSON, otherwise as text. */
function value(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}

/** Parses `name=value, name=value` to an object. */
export function members(text: string): Record<string, unknown> {
  const pairs = text.split(",").map((pair) => pair.split(/=(.*)/s).map((part) => part.trim()));
  return Object.fromEntries(pairs.filter(([name, given]) => name && given).map(([name, given]) => [name, value(given!)]));
}

/** The filters above the list. */
export class JobFilters {
  readonly #state = byId<HTMLSelectElement>("filter-state");
  readonly #kind = byId<HTMLSelectElement>("filter-kind");
  readonly #since = byId<HTMLSelectElement>("filter-since");
  readonly #metadata = byId<HTMLInputElement>("filter-metadata");

  constructor(changed: () => void) {
    byId("filters").addEventListener("change", () => {
      byId("filtered").textContent = this.isAny ? "on" : "";
      changed();
    });
  }

  /** Returns whether any filter is set. */
  get isAny(): boolean {
    return this.query() !== "";
  }

  /** Returns the filters as query parameters, to be appended to others. */
  query(): string {
    const wanted = members(this.#metadata.value);
    const asked = {
      state: this.#state.value,
      kind: this.#kind.value,
      created_from: this.#since.value && new Date(Date.now() - Number(this.#since.value) * HOUR_MS).toISOString(),
      metadata: Object.keys(wanted).length ? JSON.stringify(wanted) : "",
    };
    return Object.entries(asked).filter(([, given]) => given).map(([name, given]) => `&${name}=${encodeURIComponent(given)}`).join("");
  }
}
