// Equal items, found by hashing: corners at one place, edges between the same ends.

function capacity(count: number): number {
  return 2 ** Math.ceil(Math.log2(2 * count + 2));
}

/** Returns the first equal row for each of `count` rows of 32-bit words. */
export function firstEqual(words: Uint32Array, count: number): Uint32Array {
  const width = words.length / Math.max(count, 1);
  const mask = capacity(count) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  const first = new Uint32Array(count);
  const isEqual = (one: number, other: number) => {
    for (let k = 0; k < width; k++) {
      if (words[one * width + k] !== words[other * width + k]) return false;
    }
    return true;
  };
  for (let row = 0; row < count; row++) {
    let hash = 0x9e3779b9;
    for (let k = 0; k < width; k++) {
      hash = Math.imul(hash ^ words[row * width + k]!, 0x85ebca6b);
      hash ^= hash >>> 15;
    }
    let at = hash & mask;
    while (table[at] !== -1 && !isEqual(table[at]!, row)) at = (at + 1) & mask;
    if (table[at] === -1) table[at] = row;
    first[row] = table[at]!;
  }
  return first;
}

/** Returns the bits of numbers, with a single zero. */
export function bits(numbers: Float32Array): Uint32Array {
  const words = new Uint32Array(numbers.buffer, numbers.byteOffset, numbers.length).slice();
  for (let i = 0; i < words.length; i++) {
    if (words[i] === 0x80000000) words[i] = 0;
  }
  return words;
}

/** Edges by the ids of their ends: edge k of face f is the entry 3f + k and leads from corner k to the next. */
export interface Edges {
  /** The first edge with the same ends. */
  first: Uint32Array;
  /** For these first edges, the number of edges with the same ends. */
  count: Uint8Array;
}

/** Finds the edges that faces share, by the ids of their corners. */
export function edgesOf(corner: Uint32Array): Edges {
  const n = corner.length;
  const words = new Uint32Array(2 * n);
  for (let i = 0; i < n; i++) {
    const [from, to] = [corner[i]!, corner[next(i)]!];
    words[2 * i] = Math.min(from, to);
    words[2 * i + 1] = Math.max(from, to);
  }
  const first = firstEqual(words, n);
  const count = new Uint8Array(n);
  for (let i = 0; i < n; i++) {
    const k = first[i]!;
    if (count[k]! < 255) count[k]!++;
  }
  return { first, count };
}

/** Returns the next corner of the same face. */
export function next(corner: number): number {
  return corner % 3 === 2 ? corner - 2 : corner + 1;
}
