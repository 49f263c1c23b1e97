// Meshes and frames of live sessions from their bytes, as openapi/live.md has them; written apart from the page, which it judges.

/** A mesh: its vertices at rest and its elements. */
export function meshOf(bytes) {
  const [dim, corners] = [bytes[1], bytes[2]];
  const [vertices, elements] = [bytes.readUInt32LE(4), bytes.readUInt32LE(8)];
  const rest = Array.from({ length: dim * vertices }, (_, k) => bytes.readDoubleLE(32 + 8 * k));
  const after = 32 + 8 * rest.length;
  return { dim, corners, rest, elements: Array.from({ length: corners * elements }, (_, k) => bytes.readUInt32LE(after + 4 * k)) };
}

/** A frame: what it says of flips, and its vertices. */
export function frameOf(bytes) {
  const [width, dim] = [bytes[1], bytes[3]];
  const vertices = bytes.readUInt32LE(32);
  const positions = Array.from({ length: dim * vertices }, (_, k) => (width === 4 ? bytes.readFloatLE(40 + 4 * k) : bytes.readDoubleLE(40 + 8 * k)));
  return { isMoving: bytes[2] === 0, step: bytes.readUInt32LE(4), message: bytes.readUInt32LE(8), flips: bytes.readUInt32LE(12), positions };
}

/** How many elements do not have the orientation that they have at rest. */
export function flips(mesh, frame) {
  let count = 0;
  for (let k = 0; k < mesh.elements.length; k += mesh.corners) {
    const size = (positions) => determinant(mesh, positions, mesh.elements.slice(k, k + mesh.corners));
    if (!(size(frame.positions) * Math.sign(size(mesh.rest)) > 0)) count += 1;
  }
  return count;
}

function determinant({ dim }, positions, [origin, ...others]) {
  const edges = others.map((v) => Array.from({ length: dim }, (_, k) => positions[dim * v + k] - positions[dim * origin + k]));
  if (dim === 2) return edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0];
  const [[a, b, c], [d, e, f], [g, h, i]] = edges;
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}
