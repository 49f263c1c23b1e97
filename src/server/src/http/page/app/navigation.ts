// The choice of how a mouse moves the surface, kept in this browser.

import { buttonsOf, type Navigation } from "../viewer/navigation";
import type { SolidPane } from "../viewer/solid_pane";
import { element } from "./dom";
import { keep, kept } from "./memory";

/** Each way with its name, and the gestures that turn, move and zoom the surface. */
const WAYS: Record<Navigation, { name: string; turn: string; move: string; zoom: string }> = {
  page: { name: "Left button turns", turn: "Drag", move: "Right drag", zoom: "Wheel" },
  blender: { name: "Blender", turn: "Middle drag", move: "Shift Middle drag", zoom: "Wheel, Ctrl Middle drag" },
  maya: { name: "Maya", turn: "Alt Drag", move: "Alt Middle drag", zoom: "Wheel, Alt Right drag" },
  rizom: { name: "RizomUV", turn: "Right drag", move: "Middle drag", zoom: "Wheel" },
};

/** Returns the kept way. */
function navigation(): Navigation {
  const { name = "page" } = kept("navigation");
  return name in WAYS ? name : "page";
}

/** Lets the camera follow the kept way. */
export function startNavigation(solid: SolidPane): void {
  solid.buttons = (event) => buttonsOf(navigation(), event);
}

/** Returns the gestures of the kept way for the list of keys. */
export function gestures(): [string, string][] {
  const { turn, move, zoom } = WAYS[navigation()];
  return [[turn, "Turn the surface"], [move, "Move the surface"], [zoom, "Zoom"], ["Drag in the UVs", "Move them"]];
}

/** Creates the field that chooses a way. */
export function navigationField(changed: () => void): HTMLElement {
  const select = element("select", { id: "navigation" }, ...Object.entries(WAYS).map(([value, { name }]) => element("option", { value, textContent: name, selected: value === navigation() })));
  select.addEventListener("change", () => {
    keep("navigation", { name: select.value as Navigation });
    changed();
  });
  return element("div", { className: "row" }, element("label", { htmlFor: "navigation", textContent: "Mouse in the 3D view" }), select);
}
