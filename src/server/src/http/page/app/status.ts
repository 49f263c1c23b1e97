// The line below the views: the element under the pointer, the meaning of the colors, problems.

import { type Analysis, type Atlas, UNMAPPED } from "../analysis/analysis";
import { type Measure, MEASURES, stretchOf } from "../analysis/distortion";
import { gradient } from "../viewer/colors";
import { levelsOf } from "../viewer/gutters";
import { CELLS, type Place } from "./address";
import { button, byId, element } from "./dom";
import { counted, percent, short, whole } from "./format";
import type { Viewer } from "./viewer";

/** Names of what a heat map shows. */
const HEATS: Record<Measure, { name: string; help: string }> = {
  "sym-dirichlet": { name: "Stretch", help: "By how much lengths are stretched or compressed, from the symmetric Dirichlet energy" },
  angle: { name: "Angle stretch", help: "By how much a face is longer along one axis than along the other" },
  area: { name: "Area stretch", help: "By how much areas are larger or smaller than on average" },
  density: { name: "Texel density", help: "Pixels of the texture per unit of length" },
};

/** Shows the hovered or selected element. */
export function showPointed(viewer: Viewer): void {
  const { pointing, place, analysis, model } = viewer;
  const said = analysis ? words(analysis, pointing.hovered?.face ?? place.face, place.chart) || summary(analysis, model !== null) : "";
  byId("pointed").textContent = [where(viewer), said].filter(Boolean).join(" · ");
}

/** Returns the position of the pointer in the UV view, and its texel counted from the corner where pictures begin. */
function where({ pointing: { at }, facts }: Viewer): string {
  if (!at || !facts) return "";
  const [u, v] = at;
  const { width, height } = facts.texture;
  return `u ${u.toFixed(4)}, v ${v.toFixed(4)} · texel ${Math.floor(u * width)}, ${Math.floor((1 - v) * height)}`;
}

function words({ chart, group, atlases, marks, values }: Analysis, face: number | null, picked: number | null): string {
  if (face === null || face === undefined) return picked === null ? "" : `Chart ${picked + 1} is selected`;
  const atlas = atlases[group[face]!];
  const at = (k: number) => (k < 3 ? percent(stretchOf(MEASURES[k]!, values[4 * face + k]!)) : short(values[4 * face + k]));
  const place = `Face ${whole(face)}`;
  if (!atlas?.isMapped || marks[face]! & UNMAPPED) return `${place} · no UVs`;
  return `${place} · chart ${chart[face]! + 1} of ${atlas.charts} · stretch ${at(0)} · angle ${at(1)} · area ${at(2)} · ${at(3)} px/unit`;
}

function summary({ faces, charts, drawn, atlases }: Analysis, isDrawn: boolean): string {
  const parts = [counted(faces, "face")];
  if (atlases.some(({ isMapped }) => isMapped)) parts.push(counted(charts, "chart"));
  if (isDrawn && drawn.count < drawn.of) parts.push(`simplified view: ${whole(drawn.count)} of ${whole(drawn.of)} faces are drawn, all are measured`);
  return parts.join(" · ");
}

/** Shows the meaning of the colors over the views; `changed` receives another measure or number of cells. */
export function showLegend(viewer: Viewer, changed: (changes: Partial<Place>) => void): void {
  const { analysis, place, atlas } = viewer;
  const shown = analysis?.atlases[atlas];
  const parts: Node[] = [];
  if (shown && place.shade === "heat") parts.push(choice(place.measure, (measure) => changed({ measure })), fitting(viewer, changed), scale(viewer));
  if (shown && place.shade === "checker") parts.push(cells(place.cells, changed));
  if (shown && place.shade === "padding") parts.push(...levels(viewer, changed));
  if (shown && place.shade === "material") parts.push(...missing(viewer.facts?.missing ?? []));
  const legend = byId("legend");
  const focused = legend.contains(document.activeElement) ? document.activeElement!.id : "";
  legend.replaceChildren(...parts);
  if (focused) byId(focused)?.focus();
  byId("faults").replaceChildren(...(shown && place.problems ? faults(shown) : []));
}

/** Names what is wrong with the UVs of an atlas. */
function faults(shown: Atlas): HTMLElement[] {
  const found = [[shown.overlapping, "overlap", "overlaps"], [shown.flipped, "flipped face", "flipped faces"], [shown.near, "face near another island", "faces near another island"],
    [shown.isMapped ? shown.unmapped : 0, "face without UVs", "faces without UVs"]] as const;
  const wrong = found.filter(([count]) => count).map(([count, one, several]) => counted(count, one, several));
  const text = wrong.join(", ");
  if (text) return [element("span", { className: "wrong", textContent: text, title: text })];
  return shown.isMapped ? [element("span", { className: "right", textContent: "No overlaps or flips" })] : [];
}

/** Names the pictures of the materials that are not shown. */
function missing(names: string[]): HTMLElement[] {
  const text = `Not shown: ${names.join(", ")}`;
  return names.length ? [element("span", { className: "wrong missing", textContent: text, title: `${text}. A picture was not chosen with the file, or cannot be read.` })] : [];
}

function choice(measure: Measure, changed: (measure: Measure) => void): HTMLElement {
  const select = element("select", { id: "measure", aria: { label: "Measure of the heat map" } }, ...MEASURES.map((value) => element("option", { value, textContent: HEATS[value].name, title: HEATS[value].help, selected: value === measure })));
  select.addEventListener("change", () => changed(select.value as Measure));
  return select;
}

function cells(now: number, changed: (changes: Partial<Place>) => void): HTMLElement {
  const select = element("select", { id: "cells", aria: { label: "Cells of the checkerboard" } }, ...CELLS.map((count) => element("option", { value: String(count), textContent: `${count} cells across`, selected: count === now })));
  select.addEventListener("change", () => changed({ cells: Number(select.value) }));
  return select;
}

/** Creates the fields of the filled texture: its level and its padding. */
function levels({ facts, place }: Viewer, changed: (changes: Partial<Place>) => void): HTMLElement[] {
  if (!facts) return [];
  const { texture } = facts;
  const padding = place.padding ?? texture.padding;
  const most = levelsOf(texture);
  const mip = Math.min(place.mip, most);
  const field = (id: string, value: number, max: number, does: (value: number) => void) => {
    const made = element("input", { id, type: "number", min: "0", max: String(max), step: "1", value: String(value) });
    made.addEventListener("change", () => made.value && made.checkValidity() && does(made.valueAsNumber));
    return made;
  };
  const side = (length: number) => Math.max(1, length >> mip);
  return [
    element("label", {}, "Mip level ", field("mip", mip, most, (value) => changed({ mip: value }))),
    element("label", {}, "Padding ", field("gutter", padding, Math.max(texture.width, texture.height), (value) => changed({ padding: value === texture.padding ? null : value })), " texels"),
    element("span", { className: "numbers", title: "Texels of the level, and the padding in them", textContent: `${side(texture.width)} × ${side(texture.height)} texels · padding ${short(padding / 2 ** mip)} of them` }),
  ];
}

function scale(viewer: Viewer): HTMLElement {
  const { measure } = viewer.place;
  const spread = viewer.analysis?.atlases[viewer.atlas]?.spreads[MEASURES.indexOf(measure)];
  if (!spread) return element("span", { textContent: "No UVs to measure" });
  const [from, to] = viewer.range();
  const bar = element("span", { className: "bar", aria: { hidden: "true" } });
  bar.style.background = gradient(measure);
  const isDensity = measure === "density";
  const end = (x: number) => (isDensity ? short(x) : `${Math.round(1000 * x) / 10} %`);
  const of = (x: number) => (isDensity ? short(x) : percent(stretchOf(measure, x)));
  const before = viewer.analysisBeside?.atlases[0]?.spreads[MEASURES.indexOf(measure)];
  const beside = before ? ` · before: mean ${of(before.mean)} · max ${of(before.greatest)}` : "";
  return element("span", { className: "scale" },
    element("span", { className: "ends", textContent: end(from) }), bar, element("span", { className: "ends", textContent: `${end(to)}${isDensity ? " px/unit" : ""}` }),
    element("span", { className: "numbers", title: HEATS[measure].help, textContent: `min ${of(spread.least)} · mean ${of(spread.mean)} · max ${of(spread.greatest)}${beside}` }));
}

/** Creates the switch between the scale of all results and one that is fitted to the shown one. */
function fitting({ place: { scale } }: Viewer, changed: (changes: Partial<Place>) => void): HTMLElement {
  const isFitted = scale === "fitted";
  return button("Fit scale", () => changed({ scale: isFitted ? "fixed" : "fitted" }), { title: "Spread the colors over the stretch of this result alone", aria: { pressed: String(isFitted) } });
}
