// Keyboard shortcuts, and the dialog that lists them.

import { button, byId, element } from "./dom";
import { gestures, navigationField } from "./navigation";

/** A shortcut with its action. */
export interface Key {
  key: string;
  does: string;
  act: () => void;
  /** Modifiers of the shortcut. */
  ctrl?: boolean;
  shift?: boolean;
  /** Set if it works only while a view has the focus; elsewhere the key keeps its usual meaning. */
  inPane?: boolean;
  /** Set if it works only in a view that was clicked, so that people who navigate by keyboard can leave the view. */
  byPointer?: boolean;
  /** Set if another line of the list mentions it. */
  isSaid?: boolean;
}

/** The view that was clicked last, while it has the focus. */
let pressed: Element | null = null;

/** Listens to keys except while text is typed. */
export function listen(keys: () => Key[]): void {
  addEventListener("pointerdown", ({ target }) => (pressed = (target as Element).closest(".pane")), { capture: true });
  addEventListener("focusin", ({ target }) => {
    if ((target as Element).closest(".pane") !== pressed) pressed = null;
  });
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const isTyping = target.matches("input:not([type=radio], [type=checkbox]), select, textarea");
    if (isTyping || event.altKey || document.querySelector("dialog[open]")) return;
    const isCtrl = event.ctrlKey || event.metaKey;
    const pane = target.closest(".pane");
    const found = keys().find(({ key, ctrl = false, shift, inPane = false, byPointer = false }) => (!inPane || pane !== null) && (!byPointer || (pane !== null && pane === pressed)) &&
      key.toLowerCase() === event.key.toLowerCase() && ctrl === isCtrl && (shift ?? event.shiftKey) === event.shiftKey);
    if (!found) return;
    event.preventDefault();
    found.act();
  });
}

function nameOf({ key, ctrl, shift }: Key): string {
  const name = key === " " ? "Space" : key.length === 1 ? key.toUpperCase() : key;
  return [ctrl && "Ctrl", shift && "Shift", name].filter(Boolean).join(" ");
}

/** Shows all shortcuts. */
export function showKeys(keys: Key[]): void {
  const dialog = byId<HTMLDialogElement>("keys");
  const rows = [
    ...keys.filter(({ isSaid }) => !isSaid).map((key) => [nameOf(key), key.does] as const),
    ...gestures(), ["Click", "Select; elsewhere, select nothing"],
  ];
  dialog.replaceChildren(
    element("h2", { id: "keys-title", textContent: "Keys" }),
    element("dl", { className: "keys" }, ...rows.map(([key, does]) => element("div", {}, element("dt", {}, element("kbd", { textContent: key! })), element("dd", { textContent: does! })))),
    navigationField(() => showKeys(keys)),
    button("Close", () => dialog.close(), { className: "primary" }),
  );
  if (!dialog.open) dialog.showModal();
}
