// Keys, and the page that shows them.

import { button, byId, element } from "./dom";

/** A key with what it does. */
export interface Key {
  key: string;
  does: string;
  act: () => void;
}

/** Listens to keys wherever nothing is typed. */
export function listen(keys: Key[]): void {
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const isTyping = target.matches("input:not([type=radio], [type=checkbox]), select, textarea");
    if (isTyping || event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    const found = keys.find(({ key }) => key.toLowerCase() === event.key.toLowerCase());
    if (!found) return;
    event.preventDefault();
    found.act();
  });
}

/** Shows all keys. */
export function showKeys(keys: Key[]): void {
  const dialog = byId<HTMLDialogElement>("keys");
  const rows = [
    ...keys.map(({ key, does }) => [key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key, does] as const),
    ["Drag", "Turn the surface, move the UVs"], ["Right drag", "Move the surface"], ["Wheel", "Zoom to the pointer"], ["Click", "Select; elsewhere, select nothing"],
  ];
  dialog.replaceChildren(
    element("h2", { id: "keys-title", textContent: "Keys" }),
    element("dl", { className: "keys" }, ...rows.map(([key, does]) => element("div", {}, element("dt", {}, element("kbd", { textContent: key! })), element("dd", { textContent: does! })))),
    button("Close", () => dialog.close(), { className: "primary" }),
  );
  dialog.showModal();
}
