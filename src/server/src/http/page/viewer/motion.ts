// Short movements of cameras.

const still = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** Returns whether the user prefers reduced motion. */
export const isStill = still;

/** Calls `step` once per frame with a share from above 0 to 1; at once with 1 if the user prefers reduced motion. */
export function move(step: (share: number) => void, milliseconds = 380): void {
  if (still()) return step(1);
  const begin = performance.now();
  const frame = (now: number) => {
    const t = Math.min(Math.max((now - begin) / milliseconds, 0), 1);
    step(t < 1 ? t * t * (3 - 2 * t) : 1);
    if (t < 1) requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
}
