// The hovered and the selected element, the same in both views.

import type { Analysis } from "../analysis/analysis";
import type { Model } from "../viewer/model";
import type { Hit, Places, Stage } from "../viewer/stage";
import type { View } from "../viewer/surface";
import type { Place } from "./address";

/** Parts of the views that are pointed into. */
interface Shown {
  readonly stage: Stage | null;
  readonly model: Model | null;
  readonly place: Readonly<Place>;
  readonly atlas: number;
  /** Set while the plane shows relaxing charts, which cannot be pointed at. */
  readonly isRelaxing: boolean;
}

/** An element under the pointer: a face, with its chart or a seam. */
export interface Target {
  view: View;
  face: number;
  seam: number;
}

/** Maximum movement of a click in pixels; longer ones are drags. */
const CLICK = 4;

/** Follows the pointer in both views. */
export class Pointing {
  hovered: Target | null = null;
  readonly #viewer: Shown;
  readonly #root: HTMLElement;
  #next: { view: View; x: number; y: number } | null = null;
  #isAsked = false;
  /** Position of the pointer in the plane: u, v. */
  at: [number, number] | null = null;
  /** Callbacks for a change of the hovered element or of the position in the plane, and for a selection. */
  onHover: () => void = () => {};
  onSelect: (changes: Partial<Place>) => void = () => {};
  /** Handler that takes clicks instead; `isAlso` extends the selection. */
  taken: ((target: Target | null, isAlso: boolean) => void) | null = null;

  constructor(viewer: Shown, places: Places) {
    this.#viewer = viewer;
    this.#root = places.canvas.parentElement!;
    for (const view of ["solid", "plane"] as const) this.#listen(view, places[view]);
  }

  #listen(view: View, element: HTMLElement): void {
    let down: [number, number] | null = null;
    element.addEventListener("pointermove", (event) => {
      // Point at nothing while a view is moved.
      if (event.buttons) return;
      const box = element.getBoundingClientRect();
      this.#ask(view, event.clientX - box.left, event.clientY - box.top);
    });
    element.addEventListener("pointerleave", () => {
      this.#next = this.at = null;
      this.#hover(null);
      this.onHover();
    });
    element.addEventListener("pointerdown", (event) => (down = event.button === 0 ? [event.clientX, event.clientY] : null));
    element.addEventListener("pointerup", (event) => {
      if (!down || CLICK < Math.hypot(event.clientX - down[0], event.clientY - down[1])) return;
      const box = element.getBoundingClientRect();
      const target = this.#at(view, event.clientX - box.left, event.clientY - box.top);
      if (this.taken) this.taken(target, event.shiftKey);
      else this.select(target);
    });
  }

  /** Picks at most once per frame. */
  #ask(view: View, x: number, y: number): void {
    this.#next = { view, x, y };
    if (this.#isAsked) return;
    this.#isAsked = true;
    requestAnimationFrame(() => {
      this.#isAsked = false;
      const at = this.#next;
      if (!at) return;
      this.#locate(at);
      this.#hover(this.#at(at.view, at.x, at.y));
    });
  }

  #locate({ view, x, y }: { view: View; x: number; y: number }): void {
    const { stage, model, isRelaxing } = this.#viewer;
    this.at = null;
    if (view === "plane" && stage && model && !isRelaxing) {
      const box = stage.plane.element.getBoundingClientRect();
      const [right, up] = stage.plane.at(box.left + x, box.top + y);
      this.at = [right / model.aspect, up];
    }
    this.onHover();
  }

  #at(view: View, x: number, y: number): Target | null {
    const { stage, model, place } = this.#viewer;
    if (!stage || !model || (view === "plane" && this.#viewer.isRelaxing)) return null;
    const hit: Hit | null = stage.pick(model, view, x, y, place.aim === "seam");
    if (!hit || (place.aim === "seam" && hit.border < 0)) return null;
    return { view, face: hit.face, seam: place.aim === "seam" ? (model.analysis.borders.seam[hit.border] ?? -1) : -1 };
  }

  #hover(target: Target | null): void {
    const isSame = target?.face === this.hovered?.face && target?.seam === this.hovered?.seam;
    this.hovered = target;
    if (isSame) return;
    this.apply();
    this.onHover();
  }

  /** Selects an element, or nothing. */
  select(target: Target | null): void {
    const { place, model } = this.#viewer;
    const none = { face: null, chart: null, seam: null };
    if (!target || !model) return this.onSelect(none);
    const { chart, group, atlases } = model.analysis;
    const index = { face: target.face, chart: chart[target.face]!, seam: target.seam }[place.aim];
    this.onSelect({ ...none, atlas: atlases[group[target.face]!]?.name ?? place.atlas, [place.aim]: index });
  }

  /** Shows the hovered and the selected element in the views, and in the attributes of their holder. */
  apply(): void {
    const { stage, model, place, atlas } = this.#viewer;
    if (!stage || !model) return;
    const { hovered } = this;
    const of = ids(model.analysis, place.aim, hovered);
    stage.uniforms.uHover.value.set(...of);
    stage.uniforms.uSelected.value.set(place.face ?? -1, place.chart ?? -1, place.chart === null ? -1 : atlas, place.seam ?? -1);
    const said = { hoverFace: hovered?.face, hoverChart: hovered ? model.analysis.chart[hovered.face] : undefined, hoverSeam: hovered && 0 <= hovered.seam ? hovered.seam : undefined };
    for (const [name, value] of Object.entries(said)) {
      if (value === undefined) delete this.#root.dataset[name];
      else this.#root.dataset[name] = String(value);
    }
    stage.redraw();
  }
}

/** Returns the values of `uHover`: those of the aimed element, -1 for the others. */
function ids({ chart, group }: Analysis, aim: string, target: Target | null): [number, number, number, number] {
  if (!target) return [-1, -1, -1, -1];
  if (aim === "face") return [target.face, -1, -1, -1];
  if (aim === "seam") return [-1, -1, -1, target.seam];
  return [-1, chart[target.face]!, group[target.face]!, -1];
}
