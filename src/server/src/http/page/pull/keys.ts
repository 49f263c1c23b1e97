// Keyboard shortcuts of pulling.

import { type Key, showKeys } from "../app/keys";
import type { PullView } from "./pull_view";

/** Returns all shortcuts while something is pulled. */
export function pullKeys(pull: PullView): Key[] {
  const pulls = (key: string, does: string, wish: string, more: Partial<Key> = {}): Key => ({ key, does, act: () => pull.does(wish), ...more });
  const keys: Key[] = [
    pulls("g", "Grab the selected handles: they follow the pointer until you click", "grab"), pulls("r", "Rotate them", "rotate"),
    pulls("s", "Scale them", "scale"), pulls("Enter", "Leave them there", "confirm", { inPane: true }), pulls("Escape", "Put them back; select nothing", "cancel"),
    pulls("p", "Pin what is below the pointer", "pin"), pulls("l", "Lock: stay when others are moved together", "lock"),
    pulls("Tab", "Next handle", "next", { shift: false, inPane: true }), pulls("a", "Select all handles", "all"), pulls("x", "Let go", "let_go"), pulls("Delete", "Let go", "let_go"),
    pulls("z", "Undo", "undo", { ctrl: true, shift: false }), pulls("z", "Redo", "redo", { ctrl: true, shift: true }),
    pulls("f", "Show everything", "frame"), pulls("b", "Bake: make a job of what is shown", "bake"),
    { key: "?", does: "These keys", act: () => showKeys(keys) },
  ];
  return keys;
}
