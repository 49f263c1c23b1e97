// Keyboard shortcuts of arranging.

import { type Key, showKeys } from "../app/keys";
import type { ArrangeView } from "./arrange_view";

const CHARACTERS = [..."0123456789.-", "Backspace"];

/** Returns all shortcuts while islands are arranged. */
export function arrangeKeys(view: ArrangeView): Key[] {
  const does = (key: string, text: string, wish: string, more: Partial<Key> = {}): Key => ({ key, does: text, act: () => view.does(wish), ...more });
  const keys: Key[] = [
    does("g", "Grab the selected islands: they follow the pointer until you click", "grab"), does("r", "Rotate them", "rotate"), does("s", "Scale them", "scale"),
    does("x", "Move along u only", "x"), does("y", "Move along v only", "y"),
    { key: "0 … 9", does: "Type degrees, a factor, or a way along u or v", act: () => {} },
    ...CHARACTERS.map((key) => ({ key, does: "", act: () => view.type(key), isSaid: true })),
    does("Enter", "Leave them there", "confirm", { inPane: true }), does("Escape", "Put them back; select nothing", "cancel"),
    does("n", "Select the next island", "next", { shift: false }), does("n", "Select the island before", "previous", { shift: true }),
    does("l", "Lock, or let go; what is moved is locked", "lock"), does("a", "Select all islands", "all"), does("m", "Let the other islands make room while some are moved, or not", "room"), does("b", "Bake: make a job of all islands where they lie", "bake"),
    does("p", "Repack the others around the locked ones", "repack"),
    does("z", "Undo", "undo", { ctrl: true, shift: false }), does("z", "Redo", "redo", { ctrl: true, shift: true }),
    { key: "f", does: "Show everything", act: () => view.viewer.frame() },
    does("Tab", "Leave; the arrangement is kept", "toggle", { shift: false, inPane: true, byPointer: true }),
    { key: "?", does: "These keys", act: () => showKeys(keys) },
  ];
  return keys;
}
