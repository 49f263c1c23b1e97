// The page's form of a file: triangles without shared corners, part by part.

/** The triangles of one primitive as one node shows them. */
export interface Part {
  /** x, y, z of three corners per face, in the units of the mesh. */
  positions: Float32Array;
  /** u, v of three corners per face, v up; null without the UV set that is shown. */
  uvs: Float32Array | null;
  /** The normals of the file, like `positions`; null without. */
  normals: Float32Array | null;
  /** Matrix of the node: 16 numbers, column by column. */
  matrix: number[];
  mesh: number;
  primitive: number;
  /** Atlas of the part: an index of `Soup.groups`. */
  group: number;
  /** The earlier part with the same mesh, or -1. Only the first is measured. */
  copyOf: number;
}

/** A group of faces that share an atlas. */
export interface Group {
  /** Name, as in reports. */
  name: string;
  label: string;
}

/** Settings by which UVs are judged. */
export interface Texture {
  width: number;
  height: number;
  /** Minimum distance between charts, in texels. */
  padding: number;
}

/** Input of an analysis. */
export interface Soup {
  parts: Part[];
  groups: Group[];
  texture: Texture;
  /** Set if lengths are measured in the scene, as for lightmaps. */
  inScene: boolean;
}

/** The measured faces: those of all parts except copies, in order. */
export interface Faces {
  count: number;
  /** 9 numbers per face. */
  positions: Float32Array;
  /** 6 numbers per face; NaN without UVs. */
  uvs: Float32Array;
  mesh: Uint32Array;
  group: Uint16Array;
}

/** Returns the measured faces of a soup, and the first one of each part. */
export function measuredFaces(soup: Soup): { faces: Faces; begins: number[] } {
  const begins: number[] = [];
  let count = 0;
  soup.parts.forEach((part) => {
    begins.push(0 <= part.copyOf ? (begins[part.copyOf] ?? 0) : count);
    if (part.copyOf < 0) count += part.positions.length / 9;
  });
  const faces: Faces = {
    count,
    positions: new Float32Array(9 * count),
    uvs: new Float32Array(6 * count).fill(Number.NaN),
    mesh: new Uint32Array(count),
    group: new Uint16Array(count),
  };
  soup.parts.forEach((part, k) => {
    if (0 <= part.copyOf) return;
    const begin = begins[k] ?? 0;
    const placed = soup.inScene ? moved(part.positions, part.matrix) : part.positions;
    faces.positions.set(placed, 9 * begin);
    if (part.uvs) faces.uvs.set(part.uvs, 6 * begin);
    const end = begin + part.positions.length / 9;
    // Each node of a lightmap has a surface of its own.
    faces.mesh.fill(soup.inScene ? k : part.mesh, begin, end);
    faces.group.fill(part.group, begin, end);
  });
  return { faces, begins };
}

/** Returns points transformed by a matrix. */
export function moved(points: Float32Array, matrix: number[]): Float32Array {
  const m = Float64Array.from(matrix);
  const result = new Float32Array(points.length);
  for (let i = 0; i < points.length; i += 3) {
    const [x, y, z] = [points[i]!, points[i + 1]!, points[i + 2]!];
    for (let k = 0; k < 3; k++) {
      result[i + k] = m[k]! * x + m[4 + k]! * y + m[8 + k]! * z + m[12 + k]!;
    }
  }
  return result;
}
