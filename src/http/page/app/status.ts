// The line below the views: what is pointed at, what the colors mean, what is wrong.

import type { Analysis } from "../analysis/analysis";
import { type Measure, MEASURES } from "../analysis/distortion";
import { gradient } from "../viewer/colors";
import { byId, element } from "./dom";
import { counted, short, whole } from "./format";
import { MEASURE_NAMES } from "./toolbar";
import type { Viewer } from "./viewer";

/** Says what is pointed at, or selected. */
export function showPointed({ pointing, place, analysis, model }: Viewer): void {
  byId("pointed").textContent = analysis ? words(analysis, pointing.hovered?.face ?? place.face, place.chart) || summary(analysis, model !== null) : "";
}

function words({ chart, group, atlases, values }: Analysis, face: number | null, picked: number | null): string {
  if (face === null || face === undefined) return picked === null ? "" : `Chart ${picked + 1} is selected`;
  const atlas = atlases[group[face]!];
  const at = (k: number) => short(values[4 * face + k]);
  const place = `Face ${whole(face)}`;
  if (!atlas?.isMapped) return `${place} · no UVs`;
  return `${place} · chart ${chart[face]! + 1} of ${atlas.charts} · sym. Dirichlet ${at(0)} · angle ${at(1)} · area ${at(2)} · ${at(3)} px/unit`;
}

function summary({ faces, charts, drawn, atlases }: Analysis, isDrawn: boolean): string {
  const parts = [counted(faces, "face")];
  if (atlases.some(({ isMapped }) => isMapped)) parts.push(counted(charts, "chart"));
  if (isDrawn && drawn.count < drawn.of) parts.push(`simplified view: ${whole(drawn.count)} of ${whole(drawn.of)} faces are drawn, all are measured`);
  return parts.join(" · ");
}

/** Says what the colors mean; `changed` is told of another measure. */
export function showLegend(viewer: Viewer, changed: (measure: Measure) => void): void {
  const { analysis, place, atlas } = viewer;
  const shown = analysis?.atlases[atlas];
  const parts: (Node | null)[] = shown && place.shade === "heat" ? [choice(place.measure, changed), scale(viewer)] : [];
  if (shown && place.problems) {
    const found = [[shown.overlapping, "overlap", "overlaps"], [shown.flipped, "flipped face", "flipped faces"], [shown.near, "face near another island", "faces near another island"]] as const;
    const wrong = found.filter(([count]) => count).map(([count, one, several]) => counted(count, one, several));
    if (wrong.length) parts.push(element("span", { className: "wrong", textContent: wrong.join(", ") }));
    else if (shown.isMapped) parts.push(element("span", { className: "right", textContent: "No overlaps or flips" }));
  }
  byId("legend").replaceChildren(...parts.filter((part) => part !== null));
}

function choice(measure: Measure, changed: (measure: Measure) => void): HTMLElement {
  const select = element("select", { id: "measure", aria: { label: "Measure of the heat map" } }, ...MEASURES.map((value) => element("option", { value, textContent: MEASURE_NAMES[value], selected: value === measure })));
  select.addEventListener("change", () => changed(select.value as Measure));
  return select;
}

function scale(viewer: Viewer): HTMLElement {
  const { measure } = viewer.place;
  const spread = viewer.analysis?.atlases[viewer.atlas]?.spreads[MEASURES.indexOf(measure)];
  if (!spread) return element("span", { textContent: "No UVs to measure" });
  const [from, to] = viewer.range();
  const bar = element("span", { className: "bar", aria: { hidden: "true" } });
  bar.style.background = gradient(measure);
  const unit = measure === "density" ? " px/unit" : "";
  return element("span", { className: "scale" },
    element("span", { className: "ends", textContent: short(from) }), bar, element("span", { className: "ends", textContent: `${short(to)}${unit}` }),
    element("span", { className: "numbers", title: MEASURE_NAMES[measure], textContent: `min ${short(spread.least)} · mean ${short(spread.mean)} · max ${short(spread.greatest)}` }));
}
