// Which jobs the list shows.

import { byId } from "./dom";

const HOUR_MS = 3_600_000;

/** A member of metadata as the service compares it: what reads as JSON is JSON, all else a text. */
function value(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return text;
  }
}

/** `name=value, name=value` as an object. */
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

  /** Whether the list may lack jobs. */
  get isAny(): boolean {
    return this.query() !== "";
  }

  /** What is asked for, behind other parameters. */
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
