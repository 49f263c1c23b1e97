// The worker: a soup in, its analysis out. Buffers are handed over, not copied.

import { analyze } from "./analysis";
import type { Soup } from "./soup";

self.onmessage = ({ data }: MessageEvent<{ id: number; soup: Soup }>) => {
  try {
    const analysis = analyze(data.soup);
    const buffers = [
      ...Object.values(analysis.drawn), ...Object.values(analysis.borders), analysis.group, analysis.chart,
      analysis.marks, analysis.values, analysis.texels,
    ].filter(ArrayBuffer.isView).map((view) => view.buffer);
    self.postMessage({ id: data.id, analysis }, { transfer: [...new Set(buffers)] });
  } catch (error) {
    self.postMessage({ id: data.id, error: String(error) });
  }
};
