// Islands that are closer to each other than the padding.

import type { Charts } from "./charts";
import { meetingBoxes } from "./grid";
import type { Faces, Texture } from "./soup";
import { next } from "./weld";

/** Share of a texel below which a difference is rounding. */
const TOLERANCE = 1e-3;

/** Marks each of `charts.borders` that is nearer than the padding to a border of another chart of its group. */
export function nearBorders(faces: Pick<Faces, "uvs" | "group">, charts: Pick<Charts, "borders" | "ofFace">, texture: Texture): Uint8Array {
  const near = new Uint8Array(charts.borders.length);
  const limit = texture.padding - TOLERANCE;
  if (!(0 < limit)) return near;
  const ends = borderEnds(faces, charts, texture);
  const boxes = new Float64Array(ends.length);
  for (let k = 0; k < ends.length; k += 4) {
    const half = limit / 2;
    boxes[k] = Math.min(ends[k]!, ends[k + 2]!) - half;
    boxes[k + 1] = Math.min(ends[k + 1]!, ends[k + 3]!) - half;
    boxes[k + 2] = Math.max(ends[k]!, ends[k + 2]!) + half;
    boxes[k + 3] = Math.max(ends[k + 1]!, ends[k + 3]!) + half;
  }
  const of = (border: number) => Math.floor(charts.borders[border]! / 3);
  meetingBoxes(boxes, Math.max(4 * texture.padding, 8), (one, other) => {
    const [a, b] = [of(one), of(other)];
    if (faces.group[a] !== faces.group[b] || charts.ofFace[a] === charts.ofFace[b]) return;
    if (segmentDistance(ends, 4 * one, ends, 4 * other) < limit) near[one] = near[other] = 1;
  });
  return near;
}

function borderEnds(faces: Pick<Faces, "uvs">, charts: Pick<Charts, "borders">, { width, height }: Texture): Float64Array {
  const ends = new Float64Array(4 * charts.borders.length);
  charts.borders.forEach((edge, k) => {
    [edge, next(edge)].forEach((corner, end) => {
      ends[4 * k + 2 * end] = faces.uvs[2 * corner]! * width;
      ends[4 * k + 2 * end + 1] = faces.uvs[2 * corner + 1]! * height;
    });
  });
  return ends;
}

/** Returns the distance of two segments that do not cross: four numbers each, at places of two lists. */
export function segmentDistance(a: Float64Array, i: number, b: Float64Array, j: number): number {
  return Math.min(toSegment(a, i, b, j), toSegment(a, i + 2, b, j), toSegment(b, j, a, i), toSegment(b, j + 2, a, i));
}

function toSegment(points: Float64Array, point: number, ends: Float64Array, segment: number): number {
  const [u, v] = [ends[segment]!, ends[segment + 1]!];
  const [du, dv] = [ends[segment + 2]! - u, ends[segment + 3]! - v];
  const [pu, pv] = [points[point]! - u, points[point + 1]! - v];
  const length = du * du + dv * dv;
  const t = 0 < length ? Math.min(Math.max((pu * du + pv * dv) / length, 0), 1) : 0;
  return Math.hypot(pu - t * du, pv - t * dv);
}
