// Gestures of the pointer that move things.

/** Effect of a gesture on things that are moved together. */
export type Gesture = "grab" | "rotate" | "scale";

type Pixel = readonly [number, number];

/** Returns the degrees, counter-clockwise on the screen, by which a pointer moved around a center; pixels count
 * downward. */
export function swept(center: Pixel, from: Pixel, to: Pixel): number {
  const [[ax, ay], [bx, by]] = [arm(center, from), arm(center, to)];
  return (-Math.atan2(ax * by - ay * bx, ax * bx + ay * by) * 180) / Math.PI;
}

/** Returns the factor by which its distance from a center grew. */
export function stretched(center: Pixel, from: Pixel, to: Pixel): number {
  return Math.hypot(...arm(center, to)) / Math.max(Math.hypot(...arm(center, from)), 1);
}

function arm([x, y]: Pixel, [px, py]: Pixel): Pixel {
  return [px - x, py - y];
}
