// Decoding of relaxing charts: see openapi/live.md.

/** The map of a chart as the solver has it. */
export interface ChartMap {
  surface: number;
  /** First face; with the surface, it identifies the chart. */
  first: number;
  iteration: number;
  /** Number of faces of the chart; not all may follow. */
  total: number;
  flips: number;
  /** Set for a map of a simplified mesh on which seams are planned; each of its faces stands for one near it. */
  isPlan: boolean;
  /** Length of the surface per unit of the map. */
  unit: number;
  faces: Uint32Array;
  /** u, v of three corners per face. */
  corners: Float32Array | Float64Array;
}

/** Charts that moved. */
export interface MapFrame { number: string; maps: ChartMap[] }

const HEADER = 16;
const MAP_HEADER = 56;

/** Reads a frame. */
export function decodeMaps(buffer: ArrayBuffer): MapFrame {
  const view = new DataView(buffer);
  const maps: ChartMap[] = [];
  for (let at = HEADER; at < buffer.byteLength;) {
    const [surface, first, iteration, total, n, flips, width, plan] = [0, 4, 8, 12, 16, 20, 24, 28].map((k) => view.getUint32(at + k, true)) as [number, number, number, number, number, number, number, number];
    const unit = view.getFloat64(at + 32, true);
    const begin = at + MAP_HEADER;
    const end = begin + 4 * n;
    at = end + 6 * n * width;
    // Copy the bytes: numbers of eight bytes may be unaligned.
    const bytes = buffer.slice(end, at);
    const corners = width === 4 ? new Float32Array(bytes) : new Float64Array(bytes);
    maps.push({ surface, first, iteration, total, flips, isPlan: plan === 1, unit, faces: new Uint32Array(buffer.slice(begin, end)), corners });
  }
  return { number: view.getBigUint64(8, true).toString(), maps };
}
