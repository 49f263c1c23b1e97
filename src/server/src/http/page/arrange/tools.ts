// The tools of arranging: buttons above the views while islands are arranged, and shortcuts below them.

import { button, byId, element } from "../app/dom";
import type { Gesture } from "../viewer/gesture";

const CHANGES = [["Undo", "Ctrl Z", "undo"], ["Redo", "Ctrl Shift Z", "redo"]] as const;
const GESTURES = [["Grab", "G", "grab"], ["Rotate", "R", "rotate"], ["Scale", "S", "scale"]] as const;
const HELDS = [["Lock", "L", "lock"], ["All", "A", "all"]] as const;
const ROOM = [["Make room", "M", "room"]] as const;

/** Explanations of buttons whose text is not enough. */
const TITLES: Record<string, string> = { room: "The other islands make room while some are moved" };

const HINTS = [
  ["Click", "select"], ["Shift Click", "more"], ["G R S", "grab, rotate, scale"], ["X Y", "along an axis"], ["Enter", "leave there"], ["Esc", "put back"],
  ["L", "lock"], ["Tab", "leave"],
] as const;

/** State of the tools. */
export interface Shown { isOn: boolean; isOffered: boolean; isBusy: boolean; hasSelected: boolean; gesture: Gesture | null; makesRoom: boolean; canUndo: boolean; canRedo: boolean; canBake: boolean }

/** The button that begins, and those that it reveals. */
export class ArrangeTools {
  readonly #toggle: HTMLButtonElement;
  readonly #during: HTMLElement[];

  constructor(does: (wish: string) => void) {
    const act = ([text, key, wish]: readonly [string, string, string]) => button(text, () => does(wish), { title: `${TITLES[wish] ?? text} (${key})`, data: { does: wish } });
    const group = (label: string, acts: readonly (readonly [string, string, string])[]) => element("div", { className: "tools", aria: { role: "group", label } }, ...acts.map(act));
    this.#toggle = button("Arrange", () => does("toggle"), { id: "arrange", title: "Move islands by hand and pack the others around them (Tab)", aria: { pressed: "false" } });
    this.#during = [
      group("Change", CHANGES), group("Move", GESTURES), group("Islands", HELDS), group("Others", ROOM),
      button("Bake", () => does("bake"), { id: "arrange-bake", title: "Make a job of all islands where they lie (B)", data: { does: "bake" } }),
      button("Repack", () => does("repack"), { id: "arrange-repack", className: "primary", title: "Pack the others around the locked islands (P)" }),
    ];
    byId("toolbar").append(this.#toggle, ...this.#during);
    byId("arrange-hints").append(...HINTS.flatMap(([key, what]) => [element("kbd", { textContent: key }), ` ${what} `]));
  }

  refresh({ isOn, isOffered, isBusy, hasSelected, gesture, makesRoom, canUndo, canRedo, canBake }: Shown): void {
    this.#toggle.disabled = !isOffered;
    this.#toggle.setAttribute("aria-pressed", String(isOn));
    byId("toolbar").classList.toggle("arranging", isOn);
    byId("arrange-hints").hidden = !isOn;
    byId("faults").hidden = isOn;
    const may: Record<string, boolean> = { undo: canUndo, redo: canRedo, grab: hasSelected, rotate: hasSelected, scale: hasSelected, lock: hasSelected, all: true, room: gesture === null, bake: canBake, repack: true };
    for (const tool of this.#during) {
      tool.hidden = !isOn;
      for (const one of tool.matches("button") ? [tool as HTMLButtonElement] : tool.querySelectorAll("button")) {
        one.disabled = isBusy || !(may[one.dataset.does ?? "repack"] ?? true);
        if (one.dataset.does) one.setAttribute("aria-pressed", String(one.dataset.does === gesture || (one.dataset.does === "room" && makesRoom)));
      }
    }
  }
}
