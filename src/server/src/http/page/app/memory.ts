// What the page remembers in this browser.

import type { Grip } from "../pull/grips";
import type { Navigation } from "../viewer/navigation";
import type { Place } from "./address";
import type { FormKind } from "./definitions";
import type { Values } from "./option_form";

/** Cameras of both views; null if nobody has moved them. */
export type Camera = Pick<Place, "camera" | "plane">;

/** Options under a name. */
export interface Preset {
  name: string;
  kind: FormKind;
  options: Values;
}

/** The remembered values by name. */
interface Memory {
  /** Kind, options and gates of the form. */
  form: { kind?: FormKind; options?: Values; gates?: Values };
  /** Options that a person has saved, by name in the order of the alphabet. */
  presets: Preset[];
  /** Fill, measure and switches of the views. */
  looks: Partial<Place>;
  /** The theme that was chosen instead of the system's. */
  theme: { name?: "light" | "dark" };
  /** How a mouse moves the surface. */
  navigation: { name?: Navigation };
  /** Cameras by model, least recent first. */
  cameras: [string, Camera][];
  /** Handles by what is pulled and how, least recent first. */
  grips: [string, Grip[]][];
}

const EMPTY: Memory = { form: {}, presets: [], looks: {}, theme: {}, navigation: {}, cameras: [], grips: [] };
const key = (name: keyof Memory) => `unwrapd.${name}`;

/** Returns a remembered value, or an empty one if there is none or the browser refuses. */
export function kept<N extends keyof Memory>(name: N): Memory[N] {
  try {
    return (JSON.parse(localStorage.getItem(key(name)) ?? "null") as Memory[N] | null) ?? EMPTY[name];
  } catch {
    return EMPTY[name];
  }
}

/** Remembers a value, if the browser allows it. */
export function keep<N extends keyof Memory>(name: N, value: Memory[N]): void {
  try {
    localStorage.setItem(key(name), JSON.stringify(value));
  } catch {
    // Without storage, the page forgets.
  }
}

/** Forgets everything, as when a person signs out. */
export function forget(): void {
  for (const name of Object.keys(EMPTY) as (keyof Memory)[]) localStorage.removeItem(key(name));
}
