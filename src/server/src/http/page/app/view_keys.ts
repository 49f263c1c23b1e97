// Keyboard shortcuts of the views.

import { MEASURES } from "../analysis/distortion";
import type { ArrangeView } from "../arrange/arrange_view";
import { SHADES } from "../viewer/look";
import type { Place } from "./address";
import { type Key, showKeys } from "./keys";
import type { Setup } from "./setup";
import { otherSet } from "./toolbar";
import { SIDES } from "./view_cube";
import type { Viewer } from "./viewer";

/** Parts of the page that shortcuts act on. */
export interface Page {
  viewer: Viewer;
  setup: Setup;
  arrange: ArrangeView;
  change: (changes: Partial<Place>) => void;
  compare: (uvs: "before" | "both") => void;
}

const cycle = <T>(all: readonly T[], at: T, step = 1) => all[(all.indexOf(at) + step + all.length) % all.length]!;

/** Steps of the arrow keys and of plus and minus: degrees around the surface, shares of the plane, and a factor. */
const TURN = 15;
const NUDGE = 0.1;
const ZOOM = 1.25;

/** Moves the camera of the view that has the focus. */
function steer({ stage }: Viewer, right: number, up: number, farther = 1): void {
  if (document.activeElement?.closest("#plane, #plane-beside")) stage?.plane.nudge(NUDGE * right, NUDGE * up, farther);
  else stage?.solid.orbit(TURN * right, TURN * up, farther);
  stage?.redraw();
}

/** Returns the face to fly to: the selected one, or the first one of the selected island. */
function selectedFace({ place, analysis, atlas }: Viewer): number | null {
  if (place.face !== null || place.chart === null || !analysis) return place.face;
  const found = analysis.chart.findIndex((chart, face) => chart === place.chart && analysis.group[face] === atlas);
  return 0 <= found ? found : null;
}

/** Returns the shortcuts that move the camera of a view, and the one that selects islands one after the other. */
function steering(page: Page): Key[] {
  const { viewer } = page;
  const select = (step: number) => {
    const count = viewer.analysis?.atlases[viewer.atlas]?.charts ?? 0;
    if (!count) return;
    const from = viewer.place.chart ?? (0 < step ? -1 : 0);
    page.change({ aim: "chart", chart: (from + step + count) % count, face: null, seam: null });
  };
  const arrow = (key: string, right: number, up: number): Key => ({ key, does: "", isSaid: true, inPane: true, act: () => steer(viewer, right, up) });
  const zoom = (key: string, farther: number): Key => ({ key, does: "", isSaid: true, inPane: true, act: () => steer(viewer, 0, 0, farther) });
  const look = (key: string, side: 0 | 1 | 2): Key => ({ key, does: `Look from the ${["front", "right", "top"][side]}`, act: () => viewer.stage?.solid.lookFrom(SIDES[side][1]) });
  return [
    look("4", 0), look("5", 1), look("6", 2),
    { key: "n", does: "Select the next island", shift: false, act: () => select(1) },
    { key: "n", does: "Select the island before", shift: true, act: () => select(-1) },
    { key: "Arrow keys", does: "In a view: turn the surface, move the UVs", act: () => {} },
    { key: "+ −", does: "In a view: zoom", act: () => {} },
    arrow("ArrowLeft", -1, 0), arrow("ArrowRight", 1, 0), arrow("ArrowUp", 0, 1), arrow("ArrowDown", 0, -1),
    zoom("+", 1 / ZOOM), zoom("=", 1 / ZOOM), zoom("-", ZOOM),
  ];
}

/** Returns all shortcuts for a shown file. */
export function viewKeys(page: Page): Key[] {
  const { viewer } = page;
  const shades = () => SHADES.filter((shade) => shade !== "image" || viewer.hasImage);
  const keys: Key[] = [
    { key: "o", does: "Choose files", act: () => page.setup.ask() },
    { key: "u", does: "Unwrap", act: () => void page.setup.submit() },
    { key: "s", does: "Save the result", act: () => document.querySelector<HTMLElement>("#inspector .files a.primary")?.click() },
    { key: "c", does: "Next fill: charts, checker, heat map …", act: () => page.change({ shade: cycle(shades(), viewer.place.shade) }) },
    { key: "h", does: "Heat map, and its next measure", act: () => page.change(viewer.place.shade === "heat" ? { measure: cycle(MEASURES, viewer.place.measure) } : { shade: "heat" }) },
    { key: "e", does: "Seams", act: () => page.change({ seams: !viewer.place.seams }) },
    { key: "w", does: "Wire", act: () => page.change({ wire: !viewer.place.wire }) },
    { key: "x", does: "Problems in red", act: () => page.change({ problems: !viewer.place.problems }) },
    { key: "i", does: "Isolate the selected chart", act: () => page.change({ only: !viewer.place.only }) },
    { key: "1", does: "Point at faces", act: () => page.change({ aim: "face" }) },
    { key: "2", does: "Point at charts", act: () => page.change({ aim: "chart" }) },
    { key: "3", does: "Point at seams", act: () => page.change({ aim: "seam" }) },
    ...steering(page),
    { key: "Escape", does: "Select nothing", act: () => viewer.pointing.select(null) },
    { key: "f", does: "Show the selection, or everything", act: () => viewer.frameSelection() },
    { key: "Home", does: "Show everything", act: () => viewer.frame() },
    { key: "v", does: "Fly to the selected face or island", act: () => { const face = selectedFace(viewer); if (face !== null) viewer.flyTo(face); } },
    { key: "b", does: "Before and after", act: () => page.compare("before") },
    { key: "d", does: "Before and after, side by side", act: () => page.compare("both") },
    { key: "t", does: "Next UV set of the file", act: () => { const sets = viewer.facts?.sets ?? []; if (1 < sets.length) page.change(otherSet(viewer, cycle(sets, viewer.facts!.set))); } },
    { key: "m", does: "The surface alone, the UVs alone, or both", act: () => page.change({ alone: cycle([null, "solid", "plane"] as const, viewer.place.alone) }) },
    { key: " ", does: "Turn, or stop", act: () => { viewer.stage?.solid.turn(!viewer.stage.solid.isTurning); viewer.stage?.redraw(); } },
    { key: "r", does: "View and report", act: () => page.change({ tab: viewer.place.tab === "view" ? "report" : "view" }) },
    { key: "Tab", does: "Arrange islands", act: () => page.arrange.does("toggle"), shift: false, inPane: true, byPointer: true },
    { key: "?", does: "These keys", act: () => showKeys(keys) },
  ];
  return keys;
}
