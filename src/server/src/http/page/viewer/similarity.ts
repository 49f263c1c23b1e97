// Similarities of the plane: rotation, scaling and translation.

/** Maps (x, y) to (a x − b y + s, b x + a y + t). */
export interface Similarity { a: number; b: number; s: number; t: number }

export type Point = readonly [number, number];

export const IDENTITY: Similarity = { a: 1, b: 0, s: 0, t: 0 };

export function applied({ a, b, s, t }: Similarity, [x, y]: Point): [number, number] {
  return [a * x - b * y + s, b * x + a * y + t];
}

/** Returns the composition of `first` and `then`. */
export function after(first: Similarity, then: Similarity): Similarity {
  const [s, t] = applied(then, [first.s, first.t]);
  return { a: then.a * first.a - then.b * first.b, b: then.b * first.a + then.a * first.b, s, t };
}

export function shifted([s, t]: Point): Similarity {
  return { ...IDENTITY, s, t };
}

/** Returns the rotation by degrees, counter-clockwise, and scaling about a point. */
export function about([x, y]: Point, degrees: number, factor: number): Similarity {
  const angle = (degrees * Math.PI) / 180;
  const [a, b] = [factor * Math.cos(angle), factor * Math.sin(angle)];
  return { a, b, s: x - a * x + b * y, t: y - b * x - a * y };
}

export function scaleOf({ a, b }: Similarity): number {
  return Math.hypot(a, b);
}

/** Returns the rotation in degrees. */
export function turnOf({ a, b }: Similarity): number {
  return (Math.atan2(b, a) * 180) / Math.PI;
}

export function isStill({ a, b, s, t }: Similarity): boolean {
  return a === 1 && b === 0 && s === 0 && t === 0;
}
