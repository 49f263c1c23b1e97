// Elements of the page.

type Properties<T> = { [K in keyof T]?: T[K] } & { data?: Record<string, string>; aria?: Record<string, string>; on?: Partial<Record<keyof HTMLElementEventMap, (event: Event) => void>> };

/** Makes an element with properties, `data-` and `aria-` attributes, listeners and children. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, properties: Properties<HTMLElementTagNameMap[K]> = {}, ...children: (Node | string | null | undefined | false)[]
): HTMLElementTagNameMap[K] {
  const { data = {}, aria = {}, on = {}, ...rest } = properties as Properties<HTMLElement> & Record<string, unknown>;
  const made = Object.assign(document.createElement(tag), rest);
  Object.assign(made.dataset, data);
  for (const [name, value] of Object.entries(aria)) made.setAttribute(name === "role" ? name : `aria-${name}`, value);
  for (const [name, listener] of Object.entries(on)) made.addEventListener(name, listener as EventListener);
  made.append(...children.filter((child): child is Node | string => child !== null && child !== undefined && child !== false));
  return made;
}

/** Returns an element that the document has. */
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  return document.getElementById(id) as T;
}

/** Creates a button with an action. */
export function button(text: string, does: () => void, properties: Properties<HTMLButtonElement> = {}): HTMLButtonElement {
  return element("button", { type: "button", textContent: text, ...properties, on: { click: does } });
}

/** Creates a description list of names and values. */
export function pairs(entries: [string, string, string?][]): HTMLElement {
  return element("dl", { className: "pairs" }, ...entries.map(([name, value, title]) =>
    element("div", title ? { title } : {}, element("dt", { textContent: name }), element("dd", { textContent: value }))));
}

const SVG = "http://www.w3.org/2000/svg";

/** Makes a part of a drawing. */
export function svg(tag: string, attributes: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
  const made = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...children);
  return made;
}

/** Converts a text to nodes; `words between backticks` become code. */
export function prose(text: string): (Node | string)[] {
  return text.split("`").map((part, index) => (index % 2 ? element("code", { textContent: part }) : part));
}
