// The UVs of a GLB from its bytes, written apart from the page, which it judges.
import { readFileSync } from "node:fs";

/** For each face of a primitive the UVs of its three corners, as the file has them. */
export function cornerUvs(path, mesh = 0, primitive = 0, set = 0) {
  const bytes = readFileSync(path);
  const length = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + length));
  const bin = bytes.subarray(28 + length);
  const { attributes, indices } = json.meshes[mesh].primitives[primitive];
  const read = (index, width) => {
    const { bufferView, byteOffset = 0, componentType, count } = json.accessors[index];
    const view = json.bufferViews[bufferView];
    const size = { 5123: 2, 5125: 4, 5126: 4 }[componentType];
    const number = { 5123: "readUInt16LE", 5125: "readUInt32LE", 5126: "readFloatLE" }[componentType];
    const at = (k, c) => (view.byteOffset ?? 0) + byteOffset + k * (view.byteStride ?? width * size) + c * size;
    return Array.from({ length: count }, (_, k) => Array.from({ length: width }, (_, c) => bin[number](at(k, c))));
  };
  const uvs = read(attributes[`TEXCOORD_${set}`], 2);
  const corners = read(indices, 1).flat();
  return Array.from({ length: corners.length / 3 }, (_, f) => [0, 1, 2].map((k) => uvs[corners[3 * f + k]]));
}
