// The divider between the surface and the UVs, moved by pointer or arrow keys.

import { MOST_SPLIT, type Place, START } from "./address";
import { byId } from "./dom";
import type { Store } from "./store";

/** Change of the surface's width by a key, in percent. */
const STEP = 5;

/** Lets the divider change the state, and shows what the state says. */
export function startDivider(store: Store, change: (changes: Partial<Place>) => void): void {
  const [divider, panes] = [byId("divider"), byId("panes")];
  const split = (to: number) => change({ split: Math.round(Math.min(Math.max(to, 100 - MOST_SPLIT), MOST_SPLIT)) });
  divider.addEventListener("pointerdown", (event) => divider.setPointerCapture(event.pointerId));
  divider.addEventListener("pointermove", (event) => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const { left, width } = panes.getBoundingClientRect();
    split((100 * (event.clientX - left)) / width);
  });
  divider.addEventListener("dblclick", () => split(START.split));
  divider.addEventListener("keydown", ({ key }) => {
    const by = { ArrowLeft: -STEP, ArrowRight: STEP }[key];
    if (by) split(store.place.split + by);
  });
  const show = () => {
    divider.setAttribute("aria-valuenow", String(store.place.split));
  };
  store.show(show);
  show();
}
