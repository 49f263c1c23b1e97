// The options of the package `watlas`, and what their values are here.

/** Texels between charts that filtering needs, the side if none is given, and the share of a texture that is filled. */
const FILTERED = 2;
const SIDE = 1024;
const FILL = 0.45;

/** Weights of seams along hard edges beyond this ask for seams there. */
const HARD = 1000;

/** How charts are made; `fixWinding` always holds. */
export function chartsAsked({ useInputMeshUvs, normalSeamWeight, fixWinding: _, ...others }) {
  const isHard = normalSeamWeight > HARD;
  warnOf('ChartOptions', isHard ? others : { normalSeamWeight, ...others });
  return { cut: useInputMeshUvs ? 'keep' : undefined, seams: isHard ? 'normals' : undefined };
}

/** How charts are laid out, for meshes of an area. */
export function layoutAsked(options, area) {
  const { padding = 0, texelsPerUnit = 0, resolution = 0, bilinear = true, bruteForce, ...others } = options;
  const { rotateCharts = true, rotateChartsToAxis = true, ...ignored } = others;
  warnOf('PackOptions', { ...ignored, ...(rotateChartsToAxis && !rotateCharts ? { rotateCharts } : {}) });
  const turned = rotateCharts ? 'quarter' : 'none';
  const needed = (area * texelsPerUnit ** 2) / FILL;
  const side = resolution || (texelsPerUnit > 0 ? Math.ceil(Math.sqrt(needed)) : SIDE);
  const texture = Math.min(65536, Math.max(16, side));
  const pages = resolution && texelsPerUnit > 0 ? Math.ceil(needed / texture ** 2) : 1;
  return {
    resolution: texture,
    padding: Math.min(padding + (bilinear ? FILTERED : 0), Math.floor(texture / 8)),
    pages: Math.min(10, Math.max(1, pages)),
    packing: bruteForce ? 'tight' : 'fast',
    rotate: rotateChartsToAxis ? 'any' : turned,
    texelsPerUnit: texelsPerUnit > 0 ? texelsPerUnit : undefined,
  };
}

/** More room for a density that does not fit, if any: a page more where its size is fixed, else a larger one. */
export function enlarged(layout, isFixed) {
  const larger = isFixed
    ? { ...layout, pages: layout.pages + 1 }
    : { ...layout, resolution: layout.resolution + Math.floor(layout.resolution / 8) };
  return larger.pages <= 10 && larger.resolution <= 65536 ? larger : undefined;
}

/** Names options that are given and have no effect. */
function warnOf(kind, ignored) {
  for (const [name, value] of Object.entries(ignored)) {
    if (value !== undefined) process.emitWarning(`unwrapd: ${kind}.${name} has no effect`);
  }
}
