// The options of `unwrapd unwrap`, which `unwrapd unwrap --help` explains, in camel case.

/** How charts are laid out. */
interface Layout {
  /** The side of a texture in texels, or `WIDTHxHEIGHT`. */
  resolution?: number | string;
  padding?: number;
  pages?: number;
  texelsPerUnit?: number;
  packing?: 'fast' | 'tight';
  /** Islands that share their texels, stacked on each other. */
  stack?: 'off' | 'keep' | 'identical' | 'mirrored';
  /** Moves all islands of a stack but the first by one tile. */
  stackOffset?: boolean;
  /** Permitted rotations of charts in the layout. */
  rotate?: 'any' | 'quarter' | 'none';
  /** Rules for islands, `SELECTOR: ACTION`, as `material=Glass: lock`. */
  control?: string[];
  /** Rectangles that rules can name, `NAME=U,V,U,V`. */
  rectangle?: string[];
  /** Islands whose nearly straight borders become straight: `auto`, `off`, or selectors as in `control`, separated by semicolons. */
  straighten?: string;
  threads?: number;
}

/** Progress of a call: the stage under way, the share of the work done, and charts mapped and known so far. */
export interface Progress {
  stage: string;
  fraction: number;
  chart: number;
  charts: number;
}

/** Where to cut, how to map and how to pack. */
export interface AtlasOptions extends Layout {
  preset?: 'material' | 'lightmap';
  mips?: number;
  cut?: 'auto' | 'fast' | 'disk' | 'keep' | 'seams';
  quality?: 'smooth' | 'balanced' | 'few';
  cones?: number;
  coneVertices?: number[];
  keptMaps?: 'optimized' | 'as-given';
  maxCharts?: number;
  maxDistortion?: number;
  maxStretch?: number;
  seamWeight?: number;
  symmetry?: 'auto' | 'off';
  /** A name, or a formula of the singular values s1 and s2. */
  energy?: string;
  barrier?: string;
  barrierStrength?: number;
  barrierSupport?: number;
  barrierContinuation?: boolean;
  pin?: 0 | 2;
  quantizationSafe?: 12 | 14 | 16;
  timeBudget?: number;
}

interface CalledOptions extends AtlasOptions {
  seams?: 'normals' | number[][];
  groupBy?: 'mesh' | 'scene' | 'material' | 'primitive';
  sourceTexcoord?: number;
  texcoord?: number;
  overwrite?: boolean;
  texelWeight?: string[];
  materialBorders?: boolean;
  heatmapMeasure?: 'conformal' | 'area' | 'symmetric-dirichlet';
  /** Ends the work. */
  signal?: AbortSignal;
  /** Is called ten times a second while the work goes on. */
  onProgress?: (progress: Progress) => void;
}

/** Options of the transform. */
export interface UnwrapDocumentOptions extends CalledOptions {
  /** Is called with the report. */
  onReport?: (report: import('./index.js').Report) => void;
}

/** Options of a file, and what belongs to it. */
export interface UnwrapFileOptions extends CalledOptions {
  /** The file's name, which tells the format where the bytes do not. */
  name?: string;
  /** The files that it refers to, by relative path. */
  resources?: Record<string, ArrayBufferView | ArrayBufferLike>;
  format?: 'glb' | 'gltf' | 'obj';
  rebake?: boolean;
  bakeTiled?: boolean;
  bakeColors?: boolean;
  bakeSize?: number;
  imageFormat?: 'source' | 'png' | 'jpeg' | 'webp';
  mergeMaterials?: string[];
}
