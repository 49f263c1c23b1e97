// Charts that relax, from their bytes, as openapi/live.md has them; written apart from the page, which it judges.

/** The maps of a frame. */
export function mapsOf(bytes) {
  const maps = [];
  for (let at = 16; at < bytes.length;) {
    const [surface, first, iteration, total, n, flips, width] = Array.from({ length: 7 }, (_, k) => bytes.readUInt32LE(at + 4 * k));
    const begin = at + 56 + 4 * n;
    const corners = Array.from({ length: 6 * n }, (_, k) => (width === 4 ? bytes.readFloatLE(begin + 4 * k) : bytes.readDoubleLE(begin + 8 * k)));
    maps.push({ surface, first, iteration, total, flips, corners });
    at = begin + 6 * n * width;
  }
  return maps;
}

/** How many faces of a map are not positive. */
export function turnedOver({ corners }) {
  let count = 0;
  for (let k = 0; k < corners.length; k += 6) {
    const [ax, ay, bx, by, cx, cy] = corners.slice(k, k + 6);
    if (!((bx - ax) * (cy - ay) - (by - ay) * (cx - ax) > 0)) count += 1;
  }
  return count;
}
