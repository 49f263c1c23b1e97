// The state in the address: the same address opens the same state.

import type { Measure } from "../analysis/distortion";
import type { Shade } from "../viewer/look";
import { kept } from "./memory";

/** State of the page that can be shared. */
export interface Place {
  job: string | null;
  tab: "view" | "report" | "batch" | "pull";
  shade: Shade;
  measure: Measure;
  /** Ends of the heat map's scale: the same for all results, or fitted to the shown one. */
  scale: "fixed" | "fitted";
  seams: boolean;
  wire: boolean;
  problems: boolean;
  /** Set if only the selected chart is shown. */
  only: boolean;
  /** Cells of the checkerboard along u. */
  cells: number;
  /** Level of the texture that is shown with its padding, and the padding in texels; null for that of the file. */
  mip: number;
  padding: number | null;
  /** A UV set other than the one that is shown first. */
  set: number | null;
  /** The UVs of a job that are shown: those that it made, those that its input had, or both side by side. */
  uvs: "after" | "before" | "both";
  /** The name of an atlas. */
  atlas: string | null;
  aim: Aim;
  face: number | null;
  chart: number | null;
  seam: number | null;
  /** The view that is shown alone; null for both. */
  alone: "solid" | "plane" | null;
  /** Width of the surface in percent of both views. */
  split: number;
  /** Set if a batch is shown as a contact sheet, not as a table. */
  sheet: boolean;
  /** Column by which a batch is sorted, with a minus if from the greatest; empty for the order in which jobs were made. */
  sort: string;
  /** Six numbers for the camera, three for the plane. */
  camera: number[] | null;
  plane: number[] | null;
}

/** Element that is hovered and selected. */
export type Aim = "face" | "chart" | "seam";

/** Greatest width of a view in percent of both, so that the other one can still be worked in. */
export const MOST_SPLIT = 80;

/** Choices for the number of cells of the checkerboard along u. */
export const CELLS = [8, 16, 32, 64, 128] as const;

export const START: Place = {
  job: null, tab: "view", shade: "charts", measure: "sym-dirichlet", scale: "fixed", seams: true, wire: false, problems: true, only: false, cells: 32, mip: 0, padding: null, set: null, uvs: "after", atlas: null,
  aim: "chart", face: null, chart: null, seam: null, alone: null, split: 50, sheet: false, sort: "", camera: null, plane: null,
};

/** Reads the fragment of the address. Without one, files look as they did last time. */
export function readPlace(): Place {
  const given = new URLSearchParams(location.hash.slice(1));
  const place: Record<string, unknown> = given.size ? { ...START } : { ...START, ...kept("looks") };
  for (const [name, text] of given) {
    if (!(name in START)) continue;
    if (name === "camera" || name === "plane") place[name] = numbers(text, name === "camera" ? 6 : 3);
    else if (name === "cells") place[name] = CELLS.find((cells) => String(cells) === text) ?? START.cells;
    else if (name === "split") place[name] = Math.min(Math.max(Number.parseInt(text, 10) || START.split, 100 - MOST_SPLIT), MOST_SPLIT);
    else if (name === "alone") place[name] = text === "solid" || text === "plane" ? text : null;
    else if (name === "mip") place[name] = /^\d+$/.test(text) ? Number(text) : START.mip;
    else if (["face", "chart", "seam", "set", "padding"].includes(name)) place[name] = /^\d+$/.test(text) ? Number(text) : null;
    else if (typeof START[name as keyof Place] === "boolean") place[name] = text === "1";
    else place[name] = text;
  }
  return place as unknown as Place;
}

function numbers(text: string, count: number): number[] | null {
  const some = text.split(",").map(Number);
  return some.length === count && some.every(Number.isFinite) ? some : null;
}

/** Returns the fragment for a state. */
export function fragmentOf(place: Place): string {
  const query = new URLSearchParams();
  for (const [name, value] of Object.entries(place)) {
    if (value === null || value === START[name as keyof Place]) continue;
    if (typeof value === "boolean") query.set(name, value ? "1" : "0");
    else if (Array.isArray(value)) query.set(name, value.map((x: number) => Number(x.toPrecision(5))).join(","));
    else query.set(name, String(value));
  }
  return query.toString().replaceAll("%2C", ",");
}

/** Writes the state to the address; with `isNew`, the browser can go back to the state before. */
export function writePlace(place: Place, isNew = false): void {
  const fragment = fragmentOf(place);
  if (fragment === location.hash.slice(1)) return;
  history[isNew ? "pushState" : "replaceState"](null, "", `${location.pathname}${location.search}${fragment ? `#${fragment}` : ""}`);
}
