// The canvas of the pull view, and the marks of handles over it.

import { byId, element, svg } from "../app/dom";
import type { Grip, Grips } from "./grips";
import { PullScene } from "./scene";

/** Creates the scene of the page's third view; null without WebGL. */
export function sceneOn(): PullScene | null {
  const pane = byId("pull-pane");
  const places = { plane: element("div", { className: "pane" }), solid: element("div", { className: "pane", hidden: true }) };
  for (const place of Object.values(places)) {
    place.tabIndex = 0;
    place.setAttribute("role", "application");
    place.setAttribute("aria-label", "What is pulled: press to hold, drag to pull");
    pane.insertBefore(place, byId("pull-grips"));
  }
  try {
    return new PullScene(byId<HTMLCanvasElement>("pull-canvas"), places);
  } catch {
    return null;
  }
}

/** Marks every handle at its place in the view. */
export function showMarks(scene: PullScene, grips: Grips): void {
  byId("pull-grips").replaceChildren(...grips.all.map((grip) => mark(scene, grip, grips.selected.has(grip.name))));
}

function mark(scene: PullScene, grip: Grip, isSelected: boolean): SVGElement {
  const [cx, cy] = scene.project(grip.to);
  const classes = ["grip", isSelected && "selected", grip.isLocked && "locked"].filter(Boolean).join(" ");
  const drawn = grip.isLocked ? svg("rect", { x: cx - 5, y: cy - 5, width: 10, height: 10, class: classes }) : svg("circle", { cx, cy, r: 6, class: classes });
  drawn.append(svg("title", {}, `Handle ${grip.name + 1}`));
  return drawn;
}
