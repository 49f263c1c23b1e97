// How the buttons of a mouse move the camera of the surface, as in programs that people know.

import { MOUSE } from "three";

/** Names of the ways. */
export type Navigation = "page" | "blender" | "maya" | "rizom";

/** Actions of the left, middle and right button; null leaves the camera alone. */
export interface Buttons {
  LEFT: MOUSE | null;
  MIDDLE: MOUSE | null;
  RIGHT: MOUSE | null;
}

const NONE: Buttons = { LEFT: null, MIDDLE: null, RIGHT: null };

/** Returns the actions for a press of a button. While Shift is held, `OrbitControls` take turning for moving. Those of
 * RizomUV are from memory: no public page that describes them was found. */
export function buttonsOf(navigation: Navigation, { altKey, ctrlKey }: Pick<PointerEvent, "altKey" | "ctrlKey">): Buttons {
  if (navigation === "blender") return { ...NONE, MIDDLE: ctrlKey ? MOUSE.DOLLY : MOUSE.ROTATE };
  if (navigation === "rizom") return { ...NONE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.ROTATE };
  if (navigation === "maya") return altKey ? { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.PAN, RIGHT: MOUSE.DOLLY } : NONE;
  return { LEFT: MOUSE.ROTATE, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN };
}
