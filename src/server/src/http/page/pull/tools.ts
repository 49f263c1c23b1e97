// The tools of the pull view: choice of the input, actions, and messages of the solver.

import { button, byId, element } from "../app/dom";
import { chosenIn, type Given } from "../app/given";
import { counted, short } from "../app/format";
import type { LiveFrame } from "../live/decode";
import type { Gesture } from "../viewer/gesture";
import type { Shade } from "../viewer/look";
import type { Grips } from "./grips";
import type { Faults } from "./islands";
import { ACCEPTED, type Way } from "./what";

/** Requests of the tools. */
export interface Asked {
  start(way: number): void;
  take(files: Given[]): void;
  resize(share: number): void;
  does(wish: string): void;
  fill(shade: Shade): void;
}

/** Buttons while pulling: name, key, command. */
const ACTS = [
  ["Undo", "Ctrl Z", "undo"], ["Redo", "Ctrl Shift Z", "redo"], ["Reset", "", "reset"],
] as const;
const GESTURES = [["Grab", "G", "grab"], ["Rotate", "R", "rotate"], ["Scale", "S", "scale"]] as const;
const HELDS = [["Lock", "L", "lock"], ["Let go", "X", "let_go"], ["Next", "Tab", "next"]] as const;

/** Fills of the surface that is seen beside pulled UVs. */
const FILLS = [["checker", "Checker"], ["heat", "Heat map"], ["material", "Texture"]] as const;

/** Hints about keys, shown below the view while something is pulled. */
const HINTS = [["Press", "hold"], ["Drag", "pull"], ["P", "pin"], ["G R S", "grab, rotate, scale"], ["L", "lock"], ["Tab", "next handle"], ["X", "let go"], ["Ctrl Z", "undo"]] as const;

/** The bar above the view and the line below it. */
export class PullTools {
  readonly #ways = element("select", { id: "pull-way", aria: { label: "What to pull" } });
  readonly #start: HTMLButtonElement;
  readonly #size = element("input", { type: "range", id: "pull-size", min: "0", max: "0.3", step: "0.01", aria: { label: "Size of a handle" } });
  readonly #fill = element("select", { id: "pull-fill", aria: { label: "Fill of the surface" } });
  readonly #name = element("strong", { id: "pull-name" });
  readonly #before: HTMLElement[];
  readonly #during: HTMLElement[];
  readonly #said = byId("pull-note");
  #waits: number[] = [];

  constructor(asked: Asked) {
    const files = element("input", { type: "file", accept: ACCEPTED, multiple: true, hidden: true, id: "pull-files", aria: { label: "File to pull" } });
    files.addEventListener("change", () => asked.take(chosenIn(files)));
    this.#start = button("Take hold", () => asked.start(this.#ways.selectedIndex), { id: "pull-start", className: "primary" });
    this.#size.addEventListener("input", () => asked.resize(Number(this.#size.value)));
    this.#fill.append(...FILLS.map(([value, textContent]) => element("option", { value, textContent })));
    this.#fill.addEventListener("change", () => asked.fill(this.#fill.value as Shade));
    const act = ([text, key, wish]: readonly [string, string, string]) =>
      button(text, () => asked.does(wish), { title: key ? `${text} (${key})` : text, data: { does: wish } });
    const group = (label: string, acts: readonly (readonly [string, string, string])[]) =>
      element("div", { className: "tools", aria: { role: "group", label } }, ...acts.map(act));
    this.#before = [this.#ways, this.#start, button("Choose a file", () => files.click(), { id: "pull-choose" })];
    this.#during = [
      this.#name, group("Change", ACTS), group("Move", GESTURES), group("Handles", HELDS),
      element("label", { className: "size", textContent: "Handle size " }, this.#size), this.#fill,
      button("Bake", () => asked.does("bake"), { id: "pull-bake", className: "primary", title: "Make a job of what is shown: written and certified (B)" }),
      button("End", () => asked.does("end"), { title: "End the session" }),
    ];
    byId("pull-tools").append(...this.#before, ...this.#during, files);
    byId("pull-hints").append(...HINTS.flatMap(([key, does]) => [element("kbd", { textContent: key }), ` ${does} `]));
    this.ended("");
  }

  /** Offers ways to pull a file, which may have been held by a number of handles before; none if it cannot be shown. */
  offer(name: string | null, ways: Way[], held: number): void {
    this.#ways.replaceChildren(...ways.map(({ name: text, title }) => element("option", { textContent: text, title })));
    this.#start.disabled = !ways.length;
    this.say(name ? `${name} can be pulled here: its shape follows your handles, live, and no element is ever inverted.${held ? ` ${counted(held, "handle")} of last time will be there.` : ""}` : "Choose a mesh, a picture or a drawing to pull.");
  }

  started(name: string, way: Way, size: number): void {
    this.#show(true);
    this.#name.textContent = name;
    this.#name.title = way.title;
    this.#size.value = String(size);
    this.#size.parentElement!.hidden = way.kind !== "deform";
    this.filled(null, false);
    this.#waits = [];
  }

  ended(why: string): void {
    this.#show(false);
    this.say(why);
    this.judged({ pairs: 0, beyond: 0, near: 0 });
    byId("pull-figures").textContent = "";
  }

  #show(isPulled: boolean): void {
    for (const tool of this.#before) tool.hidden = isPulled;
    for (const tool of this.#during) tool.hidden = !isPulled;
    byId("pull-hints").hidden = !isPulled;
  }

  /** Shows a message in the middle of the view. */
  say(text: string): void {
    this.#said.textContent = text;
    this.#said.hidden = text === "";
  }

  /** Shows a message for a moment. */
  note(text: string): void {
    this.say(text);
    setTimeout(() => this.#said.textContent === text && this.say(""), 4000);
  }

  refresh(grips: Grips, gesture: Gesture | null): void {
    const hasSelected = grips.chosen(true).length > 0;
    for (const tool of byId("pull-tools").querySelectorAll<HTMLButtonElement>("[data-does]")) {
      const { does } = tool.dataset;
      tool.disabled = ["grab", "rotate", "scale"].includes(does!) ? !grips.chosen().length : ["lock", "let_go"].includes(does!) ? !hasSelected : false;
      tool.setAttribute("aria-pressed", String(does === gesture));
    }
  }

  /** Offers the fills of the surface beside and shows which one it has; null if there is no surface beside. */
  filled(shade: Shade | null, hasPicture: boolean): void {
    this.#fill.hidden = shade === null;
    this.#fill.value = shade ?? "checker";
    this.#fill.options[2]!.disabled = !hasPicture;
  }

  /** Shows the current defects of UVs. */
  judged({ pairs, beyond, near }: Faults): void {
    const faults = [pairs ? counted(pairs, "overlap") : "", beyond ? `${counted(beyond, "face")} beyond the page` : "", near ? `${counted(near, "edge")} nearer than the padding` : ""].filter(Boolean);
    byId("pull-faults").textContent = faults.join(" · ");
  }

  /** Shows the milliseconds that a message waited for the frame that contains it. */
  waited(milliseconds: number): void {
    this.#waits = [...this.#waits.slice(-60), milliseconds];
  }

  frame({ stage, step, flips, energy, smallest }: LiveFrame): void {
    const wait = [...this.#waits].sort((a, b) => a - b)[this.#waits.length >> 1];
    byId("pull-figures").textContent = [
      `${flips} flips`, Number.isFinite(smallest) ? `smallest element ${(100 * smallest).toFixed(1)} % of rest` : "", Number.isFinite(energy) ? `energy ${short(energy)}` : "", `iteration ${step}`,
      { moving: "moving", settled: "at rest", unreached: "targets cannot be reached" }[stage], wait === undefined ? "" : `follows in ${wait.toFixed(0)} ms`,
    ].filter(Boolean).join(" · ");
  }
}
