// Filters of the job list.

import { byId } from "./dom";

const HOUR_MS = 3_600_000;

/** Time without a key after which words are searched. Shorter ones ask the service for every letter. */
const TYPING_MS = 250;

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

  /** The words that are searched among names and tags. */
  #words = "";

  constructor(changed: () => void) {
    const search = byId<HTMLInputElement>("search-jobs");
    let timer = 0;
    search.addEventListener("input", () => {
      clearTimeout(timer);
      timer = window.setTimeout(() => {
        this.#words = search.value.trim();
        changed();
      }, TYPING_MS);
    });
    byId("filters").addEventListener("change", () => {
      byId("filtered").textContent = this.#chosen() ? "on" : "";
      changed();
    });
  }

  /** Returns whether any filter is set. */
  get isAny(): boolean {
    return this.query() !== "";
  }

  /** Returns the words and the filters as query parameters, to be appended to others. */
  query(): string {
    return `${this.#words && `&search=${encodeURIComponent(this.#words)}`}${this.#chosen()}`;
  }

  #chosen(): string {
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
