// Meshes and frames of live sessions, from their bytes: see openapi/live.md.

/** Data of a session that is sent once. */
export interface LiveMesh {
  /** Coordinates of a vertex: 2 or 3. */
  dim: 2 | 3;
  /** Corners of an element: 3 or 4. */
  corners: 3 | 4;
  rest: Float64Array;
  elements: Uint32Array;
  /** Triangles to draw, over the vertices or over those of the skin. */
  triangles: Uint32Array;
  /** Four vertices for each vertex of the skin, and their weights; empty without one. */
  skin: Uint32Array;
  weights: Float32Array;
  /** Columns and rows of a picture, or zeros. */
  picture: [number, number];
}

export const STAGES = ["moving", "settled", "unreached"] as const;

/** A map between two iterations. */
export interface LiveFrame {
  stage: (typeof STAGES)[number];
  step: number;
  /** The last message that it contains. */
  message: number;
  flips: number;
  energy: number;
  smallest: number;
  positions: Float32Array | Float64Array;
}

/** Reads a binary message. */
export function decode(buffer: ArrayBuffer): { mesh: LiveMesh } | { frame: LiveFrame } {
  return new DataView(buffer).getUint8(0) === 1 ? { mesh: meshOf(buffer) } : { frame: frameOf(buffer) };
}

function meshOf(buffer: ArrayBuffer): LiveMesh {
  const view = new DataView(buffer);
  const [dim, corners] = [view.getUint8(1) as 2 | 3, view.getUint8(2) as 3 | 4];
  const [vertices, elements, triangles, skin, columns, rows] = [4, 8, 12, 16, 20, 24].map((at) => view.getUint32(at, true)) as [number, number, number, number, number, number];
  let at = 32;
  const take = <T>(make: new (buffer: ArrayBuffer, at: number, length: number) => T, length: number, bytes: number): T => {
    const taken = new make(buffer, at, length);
    at += length * bytes;
    return taken;
  };
  return {
    dim, corners,
    rest: take(Float64Array, dim * vertices, 8),
    elements: take(Uint32Array, corners * elements, 4),
    triangles: take(Uint32Array, 3 * triangles, 4),
    skin: take(Uint32Array, 4 * skin, 4),
    weights: take(Float32Array, 4 * skin, 4),
    picture: [columns, rows],
  };
}

function frameOf(buffer: ArrayBuffer): LiveFrame {
  const view = new DataView(buffer);
  const length = view.getUint32(32, true) * view.getUint8(3);
  return {
    stage: STAGES[view.getUint8(2)] ?? "moving",
    step: view.getUint32(4, true),
    message: view.getUint32(8, true),
    flips: view.getUint32(12, true),
    energy: view.getFloat64(16, true),
    smallest: view.getFloat64(24, true),
    positions: view.getUint8(1) === 4 ? new Float32Array(buffer, 40, length) : new Float64Array(buffer, 40, length),
  };
}
