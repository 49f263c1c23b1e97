// The worker that analyzes files, as a function.

import type { Analysis } from "../analysis/analysis";
import type { Soup } from "../analysis/soup";

declare const WORKER: string;

let worker: Worker | null = null;
let count = 0;

/** Analyzes a soup without keeping the page waiting. */
export function analyzed(soup: Soup): Promise<Analysis> {
  worker ??= new Worker(new URL(WORKER, import.meta.url), { type: "module" });
  const id = ++count;
  const used = worker;
  return new Promise((resolve, reject) => {
    const heard = ({ data }: MessageEvent<{ id: number; analysis?: Analysis; error?: string }>) => {
      if (data.id !== id) return;
      used.removeEventListener("message", heard);
      if (data.analysis) resolve(data.analysis);
      else reject(new Error(`The analysis failed: ${data.error}`));
    };
    used.addEventListener("message", heard);
    used.postMessage({ id, soup });
  });
}
