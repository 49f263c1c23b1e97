// Keyboard shortcuts of the views.

import { MEASURES } from "../analysis/distortion";
import type { ArrangeView } from "../arrange/arrange_view";
import { SHADES } from "../viewer/look";
import type { Place } from "./address";
import { type Key, showKeys } from "./keys";
import type { Setup } from "./setup";
import { otherSet } from "./toolbar";
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

/** Returns all shortcuts for a shown file. */
export function viewKeys(page: Page): Key[] {
  const { viewer } = page;
  const shades = () => SHADES.filter((shade) => shade !== "image" || viewer.hasImage);
  const keys: Key[] = [
    { key: "o", does: "Choose files", act: () => page.setup.ask() },
    { key: "u", does: "Unwrap", act: () => void page.setup.submit() },
    { key: "c", does: "Next fill: charts, checker, heat map …", act: () => page.change({ shade: cycle(shades(), viewer.place.shade) }) },
    { key: "h", does: "Heat map, and its next measure", act: () => page.change(viewer.place.shade === "heat" ? { measure: cycle(MEASURES, viewer.place.measure) } : { shade: "heat" }) },
    { key: "e", does: "Seams", act: () => page.change({ seams: !viewer.place.seams }) },
    { key: "w", does: "Wire", act: () => page.change({ wire: !viewer.place.wire }) },
    { key: "x", does: "Problems in red", act: () => page.change({ problems: !viewer.place.problems }) },
    { key: "i", does: "Isolate the selected chart", act: () => page.change({ only: !viewer.place.only }) },
    { key: "1", does: "Point at faces", act: () => page.change({ aim: "face" }) },
    { key: "2", does: "Point at charts", act: () => page.change({ aim: "chart" }) },
    { key: "3", does: "Point at seams", act: () => page.change({ aim: "seam" }) },
    { key: "Escape", does: "Select nothing", act: () => viewer.pointing.select(null) },
    { key: "f", does: "Show everything", act: () => viewer.frame() },
    { key: "v", does: "Fly to the selected face", act: () => viewer.place.face !== null && viewer.flyTo(viewer.place.face) },
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
