// The page's own analysis of a file. It runs in a worker, so that no view waits for it.

import { type Charts, chartsOf, seamLength } from "./charts";
import { type Distortion, distortionOf, flippedFaces } from "./distortion";
import { type Drawn, drawnOf } from "./drawn";
import { nearBorders } from "./gaps";
import { hasUvs, overlapsOf } from "./overlaps";
import { type Faces, measuredFaces, type Soup, type Texture } from "./soup";
import { type Spread, spreads } from "./statistics";
import { next } from "./weld";

/** Marks of faces, and of chart borders. */
const OVERLAPS = 1;
const FLIPPED = 2;
export const NEAR = 4;
const SEAM = 8;
export const UNMAPPED = 16;

/** Facts about one atlas. */
export interface Atlas {
  name: string;
  label: string;
  faces: number;
  charts: number;
  /** Area of its surface. */
  area: number;
  /** Set if any of its faces has UVs, and the number of faces without them. */
  isMapped: boolean;
  unmapped: number;
  /** Share of the texture that its faces cover, counting faces that overlap more than once. */
  fill: number;
  /** Bounds of the UVs. */
  bounds: [number, number, number, number];
  flipped: number;
  overlapping: number;
  near: number;
  /** Spread of each measure, in the order of `MEASURES`. */
  spreads: (Spread | null)[];
}

/** The borders of charts, in every place where the scene shows them. */
export interface Borders {
  face: Uint32Array;
  seam: Uint32Array;
  marks: Uint8Array;
  /** Six numbers each, in the scene. */
  ends: Float32Array;
  /** Four numbers each, in the plane. */
  uvs: Float32Array;
}

/** Facts about a file. */
export interface Analysis {
  drawn: Drawn;
  faces: number;
  charts: number;
  /** Length of its seams on the surface. */
  seamLength: number;
  /** Area of the surface. */
  area: number;
  /** Group of each measured face. */
  group: Uint16Array;
  chart: Uint32Array;
  marks: Uint8Array;
  /** Four values per face, as in `Distortion`. */
  values: Float32Array;
  /** Area in texels per face. */
  texels: Float64Array;
  borders: Borders;
  atlases: Atlas[];
}

/** Analyzes a soup. */
export function analyze(soup: Soup): Analysis {
  const { faces, begins } = measuredFaces(soup);
  const charts = chartsOf(faces);
  const distortion = distortionOf(faces, soup.texture);
  const marks = flippedFaces(faces, charts.ofFace, distortion.texels).map((flipped) => flipped * FLIPPED);
  for (let face = 0; face < faces.count; face++) if (!hasUvs(faces, face)) marks[face]! |= UNMAPPED;
  const near = nearBorders(faces, charts, soup.texture);
  near.forEach((isNear, k) => {
    if (isNear) marks[Math.floor(charts.borders[k]! / 3)]! |= NEAR;
  });
  const members = membersOf(faces, soup.groups.length);
  const pairs = members.map((some) => overlapsOf(faces, some, (one, other) => {
    marks[one]! |= OVERLAPS;
    marks[other]! |= OVERLAPS;
  }));
  const atlases = soup.groups.map((group, g) => ({
    ...group, ...judged(faces, members[g]!, distortion, marks, soup.texture),
    charts: charts.ofGroup[g] ?? 0, overlapping: pairs[g]!,
  }));
  const borderMarks = near.map((isNear, k) => isNear * NEAR | charts.isSeam[k]! * SEAM);
  return {
    drawn: drawnOf(soup, begins, charts.ofFace), faces: faces.count, charts: charts.count,
    seamLength: seamLength(faces, charts), area: atlases.reduce((sum, { area }) => sum + area, 0),
    group: faces.group, chart: charts.ofFace, marks, values: distortion.values, texels: distortion.texels, atlases,
    borders: bordersOf(soup, begins, charts, faces, borderMarks),
  };
}

/** Judges the faces of an atlas one by one. */
function judged(faces: Faces, members: Uint32Array, distortion: Distortion, marks: Uint8Array, { width, height }: Texture) {
  const count = (mark: number) => members.reduce((sum, face) => sum + (marks[face]! & mark ? 1 : 0), 0);
  const texels = members.reduce((sum, face) => sum + Math.abs(distortion.texels[face]!), 0);
  return {
    faces: members.length, area: members.reduce((sum, face) => sum + distortion.area[face]!, 0), isMapped: 0 < texels,
    fill: texels / (width * height), bounds: boundsOf(faces, members), flipped: count(FLIPPED), unmapped: count(UNMAPPED), near: count(NEAR),
    spreads: spreads(distortion, members),
  };
}

function membersOf(faces: Faces, groups: number): Uint32Array[] {
  const members: number[][] = Array.from({ length: groups }, () => []);
  faces.group.forEach((g, face) => members[g]!.push(face));
  return members.map((some) => Uint32Array.from(some));
}

function boundsOf(faces: Faces, members: Uint32Array): [number, number, number, number] {
  const bounds: [number, number, number, number] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const face of members) {
    for (let i = 6 * face; i < 6 * face + 6; i += 2) {
      const [u, v] = [faces.uvs[i]!, faces.uvs[i + 1]!];
      if (u < bounds[0]) bounds[0] = u;
      if (v < bounds[1]) bounds[1] = v;
      if (bounds[2] < u) bounds[2] = u;
      if (bounds[3] < v) bounds[3] = v;
    }
  }
  return bounds;
}

function bordersOf(soup: Soup, begins: number[], { borders, seam }: Charts, faces: Faces, borderMarks: Uint8Array): Borders {
  const face: number[] = [];
  const seams: number[] = [];
  const ends: number[] = [];
  const uvs: number[] = [];
  const marks: number[] = [];
  soup.parts.forEach((part, k) => {
    const begin = 3 * begins[k]!;
    const count = part.positions.length / 3;
    const m = part.matrix;
    const push = (corner: number) => {
      const p = part.positions.subarray(3 * (corner - begin), 3 * (corner - begin) + 3);
      for (let axis = 0; axis < 3; axis++) {
        ends.push(m[axis]! * p[0]! + m[4 + axis]! * p[1]! + m[8 + axis]! * p[2]! + m[12 + axis]!);
      }
      uvs.push(faces.uvs[2 * corner]!, faces.uvs[2 * corner + 1]!);
    };
    for (let i = lowerBound(borders, begin); i < borders.length && borders[i]! < begin + count; i++) {
      face.push(Math.floor(borders[i]! / 3));
      marks.push(borderMarks[i]!);
      seams.push(seam[i]!);
      push(borders[i]!);
      push(next(borders[i]!));
    }
  });
  return { face: Uint32Array.from(face), seam: Uint32Array.from(seams), ends: Float32Array.from(ends), uvs: Float32Array.from(uvs), marks: Uint8Array.from(marks) };
}

function lowerBound(sorted: Uint32Array, value: number): number {
  let [low, high] = [0, sorted.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (sorted[middle]! < value) low = middle + 1;
    else high = middle;
  }
  return low;
}
