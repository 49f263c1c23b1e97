import type { Transform } from '@gltf-transform/core';
import type { AtlasOptions, UnwrapDocumentOptions, UnwrapFileOptions } from './options.js';

export type { AtlasOptions, Progress, UnwrapDocumentOptions, UnwrapFileOptions } from './options.js';

/** What was done, quality and proofs, as `unwrapd unwrap --json` prints it. */
export interface Report {
  /** Whether all that was asked for is proven on the written bytes. */
  certified: boolean;
  warnings: string[];
  groups: Record<string, unknown>[];
  [name: string]: unknown;
}

/** Why a mesh could not be worked on. */
export class UnwrapdError extends Error {
  /** A stable name for programs, the same as in the problems of the HTTP service. */
  readonly code: string;
  /** The exit status of the command line. */
  readonly exitCode: number;
}

/** An option is out of its range, of the wrong type, or without effect. */
export class InvalidOptions extends UnwrapdError {}

/** The mesh or the file cannot be used. */
export class InvalidInput extends UnwrapdError {}

/** No valid result was found. */
export class NoValidResult extends UnwrapdError {}

/** A file that was written beside the main one. */
export interface WrittenFile {
  name: string;
  bytes: Uint8Array;
}

/**
 * Unwraps a glTF, OBJ, OFF, PLY or STL file in memory, on threads of its own. All else in it is preserved.
 * `signal` ends the work; the promise is then rejected with its reason. `onProgress` is called ten times a second.
 */
export function unwrapBytes(
  bytes: ArrayBufferView | ArrayBufferLike,
  options?: UnwrapFileOptions | null,
): Promise<{ bytes: Uint8Array; others: WrittenFile[]; report: Report }>;

/**
 * A transform of glTF-Transform that unwraps every mesh of a document; all else stays as it is. Atlases and texture
 * coordinates are those of `unwrapd unwrap`, and so is the certificate in the report.
 */
export function unwrapd(options?: UnwrapDocumentOptions): Transform;

/** There is nothing to wait for. */
export function Initialize(): Promise<void>;

/** The interface of the package `watlas`, whose atlases have options of `unwrapd unwrap` besides. */
export function withOptions(options: AtlasOptions): {
  ChartType: typeof ChartType;
  Initialize: typeof Initialize;
  Atlas: { new (): Atlas };
};

/** How a chart was mapped: here all at once, for which LSCM stands. */
export const ChartType: Readonly<{ Planar: 0; Ortho: 1; LSCM: 2; Piecewise: 3; Invalid: 4 }>;

export interface Chart {
  /** Fills an array with the chart's triangles; false if it is too short. */
  getFaceArray(jsArray: Uint32Array): boolean;
  readonly faceCount: number;
  readonly atlasIndex: number;
  readonly type: number;
  readonly material: number;
}

export interface Vertex {
  /** The page, and the chart counted over all meshes; -1 for vertices of triangles that are not finite. */
  atlasIndex: number;
  chartIndex: number;
  /** In texels, v down, as in glTF. */
  uv: [number, number];
  /** The vertex of the given mesh. */
  xref: number;
}

export interface Mesh {
  /** A chart of this mesh. */
  getChart(index: number): Chart;
  /** Fills an array with three vertices for each triangle, in the given order; false if it is too short. */
  getIndexArray(jsArray: Uint32Array): boolean;
  /** A vertex: its place, and which of the given mesh it is. */
  getVertex(index: number): Vertex;
  readonly chartCount: number;
  readonly indexCount: number;
  readonly vertexCount: number;
}

/** A mesh of triangles. Strides are in bytes. */
export interface MeshDecl {
  vertexPositionData: Float32Array;
  vertexCount: number;
  vertexPositionStride: number;
  vertexNormalData?: Float32Array;
  vertexUvData?: Float32Array;
  indexData?: Uint32Array | Uint16Array;
  vertexNormalStride?: number;
  vertexUvStride?: number;
  indexCount?: number;
  indexOffset?: number;
}

/** UVs of triangles, whose islands are to be packed. The stride is in bytes. */
export interface UvMeshDecl {
  vertexUvData: Float32Array;
  vertexCount: number;
  vertexStride: number;
  indexData?: Uint32Array | Uint16Array;
  indexCount?: number;
  indexOffset?: number;
}

/** A warning names others that are given. */
export interface ChartOptions {
  /** Keeps the present islands. */
  useInputMeshUvs?: boolean;
  /** Always holds. */
  fixWinding?: boolean;
  /** Beyond 1000 it cuts along hard edges. */
  normalSeamWeight?: number;
}

/** A warning names others that are given. */
export interface PackOptions {
  padding?: number;
  texelsPerUnit?: number;
  resolution?: number;
  bilinear?: boolean;
  bruteForce?: boolean;
}

/** Meshes that share an atlas, in the order in which they were added. */
export class Atlas {
  addMesh(meshDecl: MeshDecl): void;
  addUvMesh(meshDecl: UvMeshDecl): void;
  /** Takes the options of charts, which are made with the layout. */
  computeCharts(options?: ChartOptions): void;
  packCharts(options?: PackOptions): void;
  generate(chartOptions?: ChartOptions, packOptions?: PackOptions): void;
  getMesh(index: number): Mesh;
  /** Fills an array with the covered share of each page; false if it is too short. */
  getUtilization(jsArray: Float32Array): boolean;
  readonly width: number;
  readonly height: number;
  readonly atlasCount: number;
  readonly chartCount: number;
  readonly meshCount: number;
  readonly texelsPerUnit: number;
  delete(): void;
}
